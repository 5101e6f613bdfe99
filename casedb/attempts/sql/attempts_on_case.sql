-- Attempts on a case, newest first.
SELECT * FROM attempt_summary
WHERE case_id = :case_id
ORDER BY started_us DESC, attempt_id DESC
