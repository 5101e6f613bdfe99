-- Somebody saw outcomes by group.
INSERT INTO study_look (study_id, number, at_us, actor, person_id, query, people)
SELECT :study_id, coalesce(max(number), 0) + 1, :now_us, :actor, :person_id, :query, :people
FROM study_look WHERE study_id = :study_id
