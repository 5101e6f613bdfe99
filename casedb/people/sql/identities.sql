-- Identities: every name.
SELECT person_id, name FROM identity
