-- How many rows the audit log has, and the hash of the last.
SELECT count, hash FROM audit_head
