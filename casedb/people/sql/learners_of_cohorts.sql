-- Everybody who is or was a learner in a cohort, whether still, whether simulated, and what they did while they were:
-- attempts that they made themselves, of those how many have a known newest value of hit, and how many hit.
WITH done AS (
  SELECT person_id, attempt_id, started_us, (
    SELECT value FROM metric_value INDEXED BY metric_value_hit
    WHERE metric_value.attempt_id = attempt.attempt_id AND metric_id = 'hit'
    ORDER BY version DESC LIMIT 1) AS hit
  FROM attempt WHERE operator_name = 'person' AND person_id IS NOT NULL
), learner AS (
  SELECT cohort_id, person_id, max(to_us IS NULL) AS still
  FROM enrolment WHERE post = 'learner'
  GROUP BY cohort_id, person_id
)
SELECT learner.cohort_id, learner.person_id, still, person.kind = 'simulated' AS simulated,
  count(attempt_id) AS attempts, count(hit) AS with_hit, coalesce(sum(hit > 0), 0) AS hits
FROM learner
JOIN person USING (person_id)
LEFT JOIN done ON done.person_id = learner.person_id AND EXISTS (
  SELECT 1 FROM enrolment
  WHERE enrolment.cohort_id = learner.cohort_id AND enrolment.person_id = learner.person_id AND post = 'learner'
    AND from_us <= started_us AND (to_us IS NULL OR to_us > started_us))
GROUP BY learner.cohort_id, learner.person_id
ORDER BY learner.cohort_id, learner.person_id
