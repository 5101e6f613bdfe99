-- A person's attempts of one seed, newest first.
SELECT * FROM attempt_summary
WHERE person_id = :person_id AND seed = :seed
ORDER BY started_us DESC, attempt_id DESC
