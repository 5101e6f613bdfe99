-- Which versions of an attempt's steps there are.
SELECT DISTINCT version
FROM attempt_step
WHERE attempt_id = :attempt_id
