-- The conditions of an attempt that runs that are known by now.
SELECT condition_id, number, words FROM open_attempt_condition
WHERE attempt_id = :attempt_id
