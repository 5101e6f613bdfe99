-- Scores of every attempt, older versions of a metric before newer ones.
SELECT metric_value.attempt_id, metric_id, version, position, value, unit, reason
FROM metric_value
ORDER BY attempt_id, metric_id, version
