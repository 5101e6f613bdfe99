-- One attempt.
SELECT * FROM attempt_summary
WHERE attempt_id = :attempt_id
