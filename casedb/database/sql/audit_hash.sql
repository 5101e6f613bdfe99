-- The hash of a row of the audit log.
SELECT hash FROM audit
WHERE sequence = :sequence
