-- Whose answers they are.
INSERT INTO desk_response (response_id, round_id, person_id) VALUES (:response_id, :round_id, :person_id)
