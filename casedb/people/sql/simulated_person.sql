-- Somebody, if they are simulated.
SELECT 1 FROM person WHERE person_id = :person_id AND kind = 'simulated'
