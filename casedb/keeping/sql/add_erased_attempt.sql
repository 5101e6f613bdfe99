-- An empty row in the place of an attempt.
INSERT INTO erased_attempt (erasure_id, position, case_id)
VALUES (:erasure_id, :position, :case_id)
