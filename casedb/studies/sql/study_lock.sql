-- When a study's data were locked, and what they were.
SELECT locked_us, actor, person_id, pseudonym, data_hash, people FROM study_lock LEFT JOIN person USING (person_id)
WHERE study_id = :study_id
