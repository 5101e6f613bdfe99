-- Everybody who is known, named or not.
SELECT person_id FROM person
