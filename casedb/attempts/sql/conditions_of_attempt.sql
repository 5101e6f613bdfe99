-- The conditions of an attempt that are known.
SELECT condition_id, number, words FROM attempt_condition
WHERE attempt_id = :attempt_id
