-- Somebody has come: the next number, and the next of their group.
INSERT INTO workshop_participant (workshop_id, number, person_id, group_name, arrival, came_us)
SELECT :workshop_id, coalesce(max(number), 0) + 1, :person_id, :group_name,
  coalesce(max(arrival) FILTER (WHERE group_name = :group_name), -1) + 1, :now_us
FROM workshop_participant WHERE workshop_id = :workshop_id
