-- The oldest that a mentor asked for in an attempt, taken up.
UPDATE asked_event SET taken = 1
WHERE attempt_id = :attempt_id AND position = (
  SELECT min(position) FROM asked_event WHERE attempt_id = :attempt_id AND taken = 0)
RETURNING kind
