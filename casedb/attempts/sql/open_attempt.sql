-- One open attempt.
SELECT * FROM open_attempt
WHERE attempt_id = :attempt_id
