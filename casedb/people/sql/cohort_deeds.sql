-- What told_cells is made of: who came to a cohort as a learner, who left, and what they did by themselves while they
-- were in it, with the first value of hit that was stored. Simulated people are nobody to hide or to hide among.
SELECT cohort_id, person_id, from_us AS at_us, 'came' AS what FROM enrolment JOIN person USING (person_id)
WHERE kind = 'real' AND post = 'learner'
UNION ALL
SELECT cohort_id, person_id, to_us, 'left' FROM enrolment JOIN person USING (person_id)
WHERE kind = 'real' AND post = 'learner' AND to_us IS NOT NULL
UNION ALL
SELECT learner.cohort_id, learner.person_id, started_us, coalesce((
    SELECT CASE WHEN value > 0 THEN 'hit' ELSE 'miss' END FROM metric_value
    WHERE metric_value.attempt_id = attempt.attempt_id AND metric_id = 'hit' AND value IS NOT NULL
    ORDER BY version LIMIT 1), 'unknown')
FROM (SELECT DISTINCT cohort_id, person_id FROM enrolment WHERE post = 'learner') AS learner
JOIN attempt ON attempt.person_id = learner.person_id AND operator_name = 'person'
WHERE EXISTS (
  SELECT 1 FROM enrolment
  WHERE enrolment.cohort_id = learner.cohort_id AND enrolment.person_id = learner.person_id AND post = 'learner'
    AND from_us <= started_us AND (to_us IS NULL OR to_us > started_us))
