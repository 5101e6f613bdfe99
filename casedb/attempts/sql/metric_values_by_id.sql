-- Scores of those attempts, older versions of a metric before newer ones.
SELECT metric_value.attempt_id, metric_id, version, position, value, unit, reason
FROM metric_value
WHERE attempt_id IN (SELECT value FROM json_each(:attempts))
ORDER BY attempt_id, metric_id, version
