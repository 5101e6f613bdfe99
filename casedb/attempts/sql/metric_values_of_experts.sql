-- Scores of those attempts, older versions of a metric before newer ones.
SELECT metric_value.attempt_id, metric_id, version, position, value, unit, reason
FROM metric_value
WHERE attempt_id IN (
  SELECT attempt.attempt_id FROM attempt
  JOIN expert_attempt ON expert_attempt.attempt_id = attempt.attempt_id
  WHERE expert_attempt.case_id = :case_id AND expert_attempt.kind = 'simulated'
  ORDER BY started_us DESC, attempt.attempt_id DESC
  LIMIT :most
)
ORDER BY attempt_id, metric_id, version
