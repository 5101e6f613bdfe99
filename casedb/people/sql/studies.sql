-- Every study, oldest first, with how many consent.
SELECT study_id, title, created_us,
  (SELECT count(*) FROM consenting WHERE consenting.study_id = study.study_id) AS consenting
FROM study
ORDER BY created_us, study_id
