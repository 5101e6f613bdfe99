-- The audit log from :since_us on, oldest first.
SELECT sequence, at_us, actor, person_id, act, object, object_id, result, hash FROM audit
WHERE at_us >= :since_us
ORDER BY sequence
