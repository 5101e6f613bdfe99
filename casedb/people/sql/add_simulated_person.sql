-- A simulated person, who may be there already. The row that comes back tells that they were not.
INSERT INTO person (person_id, pseudonym, created_us, kind)
VALUES (:person_id, :pseudonym, :created_us, 'simulated')
ON CONFLICT (person_id) DO NOTHING
RETURNING person_id
