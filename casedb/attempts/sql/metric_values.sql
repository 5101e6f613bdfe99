-- Scores of those attempts, older versions of a metric before newer ones.
SELECT metric_value.attempt_id, metric_id, version, position, value, unit, reason
FROM metric_value
WHERE attempt_id IN (
  SELECT attempt_id FROM attempt
  ORDER BY started_us DESC, attempt_id DESC
  LIMIT :count OFFSET :first
)
ORDER BY attempt_id, metric_id, version
