-- Every open attempt, oldest first.
SELECT * FROM open_attempt
ORDER BY started_us, attempt_id
