-- Every attempt, newest first.
SELECT * FROM attempt_summary
ORDER BY started_us DESC, attempt_id DESC
