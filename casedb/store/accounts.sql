-- Every account, oldest first.
SELECT person_id, role, enabled FROM account
ORDER BY created_us, person_id
