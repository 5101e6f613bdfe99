-- Takes a draft away, with its items.
DELETE FROM curriculum
WHERE curriculum_id = :curriculum_id
