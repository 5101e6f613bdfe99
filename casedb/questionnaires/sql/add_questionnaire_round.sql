-- A round opens.
INSERT INTO questionnaire_round (round_id, code, title, form_id, version, study_id, opened_us, opened_by, at_desk)
VALUES (:round_id, :code, :title, :form_id, :version, :study_id, :now_us, :opened_by, :at_desk)
