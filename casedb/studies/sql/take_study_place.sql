-- The next place of a stratum's sequence, counted from 1.
INSERT INTO study_stratum (study_id, stratum, taken) VALUES (:study_id, :stratum, 1)
ON CONFLICT DO UPDATE SET taken = taken + 1
RETURNING taken
