-- A day opens.
INSERT INTO workshop (workshop_id, code, study_id, title, seed, opened_us, opened_by)
VALUES (:workshop_id, :code, :study_id, :title, :seed, :now_us, :opened_by)
