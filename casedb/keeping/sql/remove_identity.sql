-- Identities: a person has no name any more.
DELETE FROM identity WHERE person_id = :person_id
