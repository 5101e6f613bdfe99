-- Every study, oldest first, with how many it may be of: people who consent, or simulated ones where its plan says so.
SELECT study_id, title, created_us, of_simulated,
  (SELECT count(*) FROM consenting JOIN person USING (person_id)
   WHERE consenting.study_id = known.study_id AND kind = CASE WHEN of_simulated THEN 'simulated' ELSE 'real' END)
  AS people
FROM (
  SELECT study_id, title, created_us, EXISTS (SELECT 1 FROM study_plan
    WHERE study_plan.study_id = study.study_id AND instr(study_plan.body, '"people":"simulated"') > 0) AS of_simulated
  FROM study
) AS known
ORDER BY created_us, study_id
