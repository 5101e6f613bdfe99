-- Attempts of the people whose ids stand in the JSON list :people, and with :nobodys also those of no person, newest
-- first: :count of them from the one at :first.
SELECT * FROM attempt_summary
WHERE person_id IN (SELECT value FROM json_each(:people)) OR :nobodys AND person_id IS NULL
ORDER BY started_us DESC, attempt_id DESC
LIMIT :count OFFSET :first
