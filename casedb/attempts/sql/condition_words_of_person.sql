-- What a condition that is a word was in a person's attempts, where it is known.
SELECT attempt.attempt_id, attempt_condition.words
FROM attempt
JOIN attempt_condition ON attempt_condition.attempt_id = attempt.attempt_id
  AND attempt_condition.condition_id = :condition_id
WHERE attempt.person_id = :person_id
