-- The attempts of the JSON list :attempts, newest first.
SELECT * FROM attempt_summary
WHERE attempt_id IN (SELECT value FROM json_each(:attempts))
ORDER BY started_us DESC, attempt_id DESC
