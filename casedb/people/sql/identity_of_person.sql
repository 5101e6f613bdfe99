-- Identities: how somebody is called.
SELECT name FROM identity
WHERE person_id = :person_id
