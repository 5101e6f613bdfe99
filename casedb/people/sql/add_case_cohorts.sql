-- A case reaches the cohorts that its publisher leads now; a row comes back for each.
INSERT INTO case_cohort (case_id, cohort_id)
SELECT DISTINCT :case_id, cohort_id FROM enrolment
WHERE person_id = :person_id AND post = 'mentor' AND to_us IS NULL
RETURNING cohort_id
