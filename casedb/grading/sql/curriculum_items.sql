-- A curriculum's items in order.
SELECT position, family_id, attempt_limit FROM curriculum_item
WHERE curriculum_id = :curriculum_id
ORDER BY position
