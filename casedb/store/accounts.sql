-- Every account, oldest first.
SELECT person_id, role, password_hash, enabled FROM account
ORDER BY created_us, person_id
