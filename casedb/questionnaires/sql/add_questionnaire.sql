-- A questionnaire, for good.
INSERT INTO questionnaire (questionnaire_id, form_id, version, language, body, body_hash, stored_us)
VALUES (:questionnaire_id, :form_id, :version, :language, :body, :body_hash, :now_us)
