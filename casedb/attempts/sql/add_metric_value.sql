-- A score of an attempt.
INSERT INTO metric_value (
  attempt_id, metric_id, version, position, value, unit, reason
) VALUES (
  :attempt_id, :metric_id, :version, :position, :value, :unit, :reason
)
