-- Scores of those attempts, older versions of a metric before newer ones.
SELECT metric_value.attempt_id, metric_id, version, position, value, unit, reason
FROM metric_value
JOIN attempt ON attempt.attempt_id = metric_value.attempt_id
WHERE attempt.case_id = :case_id
ORDER BY metric_value.attempt_id, metric_id, version
