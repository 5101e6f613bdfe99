-- Somebody takes part from now on.
INSERT INTO study_enrolment (study_id, person_id, enrolled_us, group_name, stratum, position)
VALUES (:study_id, :person_id, :now_us, :group_name, :stratum, :position)
