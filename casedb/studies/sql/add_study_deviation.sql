-- Something was done otherwise than planned.
INSERT INTO study_deviation (study_id, number, at_us, actor, person_id, body)
SELECT :study_id, coalesce(max(number), 0) + 1, :now_us, :actor, :person_id, :body
FROM study_deviation WHERE study_id = :study_id
