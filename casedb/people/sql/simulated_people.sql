-- Everybody who is simulated.
SELECT person_id FROM person WHERE kind = 'simulated'
