-- Whether somebody works on a study at :now_us.
SELECT EXISTS (
  SELECT 1 FROM study_researcher
  WHERE study_id = :study_id AND person_id = :person_id AND from_us <= :now_us AND (to_us IS NULL OR to_us > :now_us)
) AS found
