-- Every cohort, with how many belong to it at :now_us and what they have done: attempts that they made themselves, and
-- of those whose newest value of hit is known, how many hit.
WITH now_in AS (
  SELECT DISTINCT cohort_id, person_id FROM enrolment
  WHERE post = 'learner' AND from_us <= :now_us AND (to_us IS NULL OR to_us > :now_us)
), done AS (
  SELECT person_id, attempt_id, (
    SELECT value FROM metric_value
    WHERE metric_value.attempt_id = attempt.attempt_id AND metric_id = 'hit'
    ORDER BY version DESC LIMIT 1) AS hit
  FROM attempt WHERE operator_name = 'person' AND person_id IS NOT NULL
)
SELECT cohort.cohort_id, title, programme, site,
  (SELECT count(*) FROM now_in WHERE now_in.cohort_id = cohort.cohort_id) AS learners,
  count(done.attempt_id) AS attempts,
  count(DISTINCT done.person_id) AS people_with_attempts,
  count(done.hit) AS with_hit,
  coalesce(sum(done.hit > 0), 0) AS hits
FROM cohort
LEFT JOIN now_in ON now_in.cohort_id = cohort.cohort_id
LEFT JOIN done ON done.person_id = now_in.person_id
GROUP BY cohort.cohort_id
ORDER BY programme, title
