-- Everybody who is or was a learner in a cohort, whether still, and whether simulated; not what they did.
SELECT cohort_id, person_id, max(to_us IS NULL) AS still, person.kind = 'simulated' AS simulated,
  0 AS attempts, 0 AS with_hit, 0 AS hits
FROM enrolment JOIN person USING (person_id)
WHERE post = 'learner'
GROUP BY cohort_id, person_id
ORDER BY cohort_id, person_id
