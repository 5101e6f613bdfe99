-- Cohorts' pages ask of every attempt whether it hit: of twenty thousand at once, and again after each new one.
CREATE INDEX metric_value_hit ON metric_value (attempt_id, version, value) WHERE metric_id = 'hit';
