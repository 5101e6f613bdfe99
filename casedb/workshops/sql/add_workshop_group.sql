-- A group of the day.
INSERT INTO workshop_group (workshop_id, place, group_name) VALUES (:workshop_id, :place, :group_name)
