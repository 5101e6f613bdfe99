-- Everybody who was ever in a cohort, in the order in which they came.
SELECT cohort_id, person_id, pseudonym, post, from_us, to_us, kind = 'simulated' AS simulated
FROM enrolment JOIN person USING (person_id)
WHERE cohort_id = :cohort_id
ORDER BY from_us, person_id
