-- Scores of the attempts that attempts_of_people answers, older versions of a metric before newer ones.
SELECT metric_value.attempt_id, metric_id, version, position, value, unit, reason
FROM metric_value
WHERE attempt_id IN (
  SELECT attempt_id FROM attempt
  WHERE person_id IN (SELECT value FROM json_each(:people)) OR :nobodys AND person_id IS NULL
  ORDER BY started_us DESC, attempt_id DESC
  LIMIT :count OFFSET :first
)
ORDER BY attempt_id, metric_id, version
