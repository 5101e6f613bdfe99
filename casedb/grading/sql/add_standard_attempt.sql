INSERT INTO standard_attempt (standard_id, attempt_id) VALUES (:standard_id, :attempt_id)
