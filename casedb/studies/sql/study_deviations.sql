-- What was done otherwise than planned, in its order.
SELECT number, at_us, actor, person_id, pseudonym, body FROM study_deviation LEFT JOIN person USING (person_id)
WHERE study_id = :study_id
ORDER BY number
