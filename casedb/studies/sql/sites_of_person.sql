-- Where somebody is or was a learner, as far as cohorts say.
SELECT DISTINCT site FROM enrolment JOIN cohort USING (cohort_id)
WHERE person_id = :person_id AND post = 'learner' AND site <> ''
ORDER BY site
