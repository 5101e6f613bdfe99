-- What led the needle in a person's attempts, where it is known.
SELECT attempt.attempt_id, attempt_condition.words
FROM attempt
JOIN attempt_condition ON attempt_condition.attempt_id = attempt.attempt_id
  AND attempt_condition.condition_id = 'needle_hand'
WHERE attempt.person_id = :person_id
