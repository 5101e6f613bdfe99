-- A cohort, unless another has its title; the row that comes back tells.
INSERT INTO cohort (cohort_id, title, programme, site, created_us)
VALUES (:cohort_id, :title, :programme, :site, :created_us)
ON CONFLICT DO NOTHING
RETURNING cohort_id
