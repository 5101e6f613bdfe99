-- Somebody works on a study from now on.
INSERT INTO study_researcher (study_id, person_id, from_us)
VALUES (:study_id, :person_id, :from_us)
