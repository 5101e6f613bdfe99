-- The next item of a curriculum.
INSERT INTO curriculum_item (curriculum_id, position, family_id, attempt_limit)
VALUES (:curriculum_id, :position, :family_id, :attempt_limit)
