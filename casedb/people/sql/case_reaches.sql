-- Whether a case that was published to a mentor's own cohort reaches :person_id: whoever published it, and who is in one
-- of the cohorts that this mentor led then.
SELECT EXISTS (
  SELECT 1 FROM case_cohort JOIN enrolment USING (cohort_id)
  WHERE case_id = :case_id AND person_id = :person_id AND to_us IS NULL
) OR EXISTS (
  SELECT 1 FROM case_decision
  WHERE case_id = :case_id AND person_id = :person_id AND decision = 'published'
) AS reaches
