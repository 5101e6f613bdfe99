-- One account.
SELECT person_id, role, password_hash, enabled FROM account
WHERE person_id = :person_id
