SELECT attempt.attempt_id AS attempt_id, attempt.person_id AS person_id
FROM standard_attempt JOIN attempt ON attempt.attempt_id = standard_attempt.attempt_id
WHERE standard_id = :standard_id
ORDER BY attempt.attempt_id
