-- Identities: gives a person a name, unless somebody has it; the row that comes back tells.
INSERT INTO identity (person_id, name, created_us)
VALUES (:person_id, :name, :created_us)
ON CONFLICT DO NOTHING
RETURNING person_id
