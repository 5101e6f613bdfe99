-- Every study, oldest first, with how many people consent, and of how many simulated ones it may be.
SELECT study_id, title, created_us,
  (SELECT count(*) FROM consenting JOIN person USING (person_id)
   WHERE consenting.study_id = study.study_id AND kind = 'real') AS consenting,
  (SELECT count(*) FROM consenting JOIN person USING (person_id)
   WHERE consenting.study_id = study.study_id AND kind = 'simulated') AS simulated
FROM study
ORDER BY created_us, study_id
