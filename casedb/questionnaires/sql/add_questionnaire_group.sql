-- A group of a round.
INSERT INTO questionnaire_group (round_id, place, group_name) VALUES (:round_id, :place, :group_name)
