INSERT INTO case_received (case_id, received_us, state, face_state, burned_in_checked_us, signing_key)
VALUES (:case_id, :received_us, :state, :face_state, :burned_in_checked_us, :signing_key)
