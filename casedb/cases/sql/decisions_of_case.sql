-- Who decided what about a version, oldest first.
SELECT decision, case_decision.person_id, pseudonym, note, decided_us, by_operator FROM case_decision
JOIN person ON person.person_id = case_decision.person_id
WHERE case_id = :case_id
ORDER BY position
