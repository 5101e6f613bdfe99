-- Scores of a person's attempts as metric_values_of_person, of those metrics alone that stand between blanks in
-- :metrics, and all that have no value for want of an endpoint.
SELECT metric_value.attempt_id, metric_id, version, position, value, unit, reason
FROM metric_value
JOIN attempt ON attempt.attempt_id = metric_value.attempt_id
WHERE attempt.person_id = :person_id
  AND (instr(:metrics, ' ' || metric_id || ' ') > 0 OR reason = 'no_endpoint')
ORDER BY metric_value.attempt_id, metric_id, version
