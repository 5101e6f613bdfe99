-- Who last did that to a thing.
SELECT actor, person_id FROM audit
WHERE act = :act AND object_id = :object_id AND result = 'done'
ORDER BY sequence DESC LIMIT 1
