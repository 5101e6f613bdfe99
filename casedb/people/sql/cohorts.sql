-- Every cohort.
SELECT cohort_id, title, programme, site FROM cohort
ORDER BY programme, title
