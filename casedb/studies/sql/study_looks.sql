-- Who saw outcomes by group, in their order.
SELECT number, at_us, actor, person_id, pseudonym, query, people FROM study_look LEFT JOIN person USING (person_id)
WHERE study_id = :study_id
ORDER BY number
