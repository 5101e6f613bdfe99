-- Scores of those attempts, older versions of a metric before newer ones.
SELECT metric_value.attempt_id, metric_id, version, position, value, unit, reason
FROM metric_value
JOIN expert_attempt ON expert_attempt.attempt_id = metric_value.attempt_id
WHERE expert_attempt.case_id = :case_id AND expert_attempt.kind = :kind
ORDER BY metric_value.attempt_id, metric_id, version
