-- A draft, in the place of an older one; a frozen plan the database keeps.
INSERT INTO study_plan (study_id, body, body_hash, stored_us)
VALUES (:study_id, :body, :body_hash, :now_us)
ON CONFLICT DO UPDATE SET body = excluded.body, body_hash = excluded.body_hash, stored_us = excluded.stored_us
