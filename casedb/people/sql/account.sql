-- One account.
SELECT person_id, role, password_hash, enabled, epoch FROM account
WHERE person_id = :person_id
