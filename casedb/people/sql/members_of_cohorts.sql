-- Everybody who is or was a learner in a cohort, and whether still; not what they did.
SELECT cohort_id, person_id, max(to_us IS NULL) AS still, 0 AS attempts, 0 AS with_hit, 0 AS hits
FROM enrolment WHERE post = 'learner'
GROUP BY cohort_id, person_id
ORDER BY cohort_id, person_id
