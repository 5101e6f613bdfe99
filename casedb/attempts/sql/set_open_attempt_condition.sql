-- A condition of an attempt that runs, as it is known by now.
INSERT INTO open_attempt_condition (attempt_id, condition_id, number, words)
VALUES (:attempt_id, :condition_id, :number, :words)
ON CONFLICT (attempt_id, condition_id) DO UPDATE SET number = excluded.number, words = excluded.words
