-- The groups of a day.
SELECT group_name FROM workshop_group WHERE workshop_id = :workshop_id ORDER BY place
