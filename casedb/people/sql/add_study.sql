-- A study, unless another has its title; the row that comes back tells.
INSERT INTO study (study_id, title, created_us)
VALUES (:study_id, :title, :created_us)
ON CONFLICT DO NOTHING
RETURNING study_id
