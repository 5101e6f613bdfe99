-- A condition of an attempt, by a number or by words.
INSERT INTO attempt_condition (attempt_id, condition_id, number, words)
VALUES (:attempt_id, :condition_id, :number, :words)
