-- A person's attempts, newest first.
SELECT * FROM attempt_summary
WHERE person_id = :person_id
ORDER BY started_us DESC, attempt_id DESC
