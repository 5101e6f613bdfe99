-- Scores of those attempts, older versions of a metric before newer ones.
SELECT metric_value.attempt_id, metric_id, version, position, value, unit, reason
FROM metric_value
WHERE attempt_id IN (
  SELECT attempt.attempt_id
  FROM (SELECT DISTINCT person_id FROM person_level WHERE level = 'consultant') AS consultant
  CROSS JOIN attempt ON attempt.person_id = consultant.person_id
  JOIN expert_attempt ON expert_attempt.attempt_id = attempt.attempt_id
  WHERE attempt.case_id = :case_id AND expert_attempt.kind = 'consultants'
)
ORDER BY attempt_id, metric_id, version
