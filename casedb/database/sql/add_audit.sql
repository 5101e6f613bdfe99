-- The next row of the audit log.
INSERT INTO audit (sequence, at_us, actor, person_id, act, object, object_id, result, hash)
VALUES (:sequence, :at_us, :actor, :person_id, :act, :object, :object_id, :result, :hash)
