-- Identities: who has that name.
SELECT person_id, name FROM identity
WHERE lower(name) = lower(:name)
