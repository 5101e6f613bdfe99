-- Scores of an attempt, older versions of a metric before newer ones.
SELECT metric_value.attempt_id, metric_id, version, position, value, unit, reason
FROM metric_value
WHERE attempt_id = :attempt_id
ORDER BY metric_id, version
