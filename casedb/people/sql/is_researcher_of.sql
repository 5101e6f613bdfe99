-- Whether somebody works on a study.
SELECT EXISTS (
  SELECT 1 FROM study_researcher
  WHERE study_id = :study_id AND person_id = :person_id AND to_us IS NULL
) AS found
