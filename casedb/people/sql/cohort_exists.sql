-- Whether there is such a cohort.
SELECT EXISTS (SELECT 1 FROM cohort WHERE cohort_id = :cohort_id) AS found
