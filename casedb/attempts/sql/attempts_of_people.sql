-- Which attempts are of the people whose ids stand in the JSON list :people, and with :nobodys also those of no person,
-- newest first: :count of them from the one at :first. Asked of an index alone.
SELECT attempt_id FROM (
  SELECT attempt_id, started_us FROM attempt WHERE person_id IN (SELECT value FROM json_each(:people))
  UNION ALL
  SELECT attempt_id, started_us FROM attempt WHERE :nobodys AND person_id IS NULL
)
ORDER BY started_us DESC, attempt_id DESC
LIMIT :count OFFSET :first
