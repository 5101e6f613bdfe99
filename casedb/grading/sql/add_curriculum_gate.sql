-- What must be reached before an item is open.
INSERT INTO curriculum_gate (curriculum_id, position, after_position, reached)
VALUES (:curriculum_id, :position, :after_position, :reached)
