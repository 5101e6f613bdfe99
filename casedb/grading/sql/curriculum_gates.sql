-- A curriculum's gates in order.
SELECT position, after_position, reached FROM curriculum_gate
WHERE curriculum_id = :curriculum_id
ORDER BY position, after_position
