-- A study's data are locked.
INSERT INTO study_lock (study_id, locked_us, actor, person_id, data_hash, people)
VALUES (:study_id, :now_us, :actor, :person_id, :data_hash, :people)
