-- What somebody decided about a version.
INSERT INTO case_decision (case_id, position, decision, person_id, note, decided_us, by_operator)
SELECT :case_id, coalesce(max(position) + 1, 0), :decision, :person_id, :note, :decided_us, :by_operator FROM case_decision
WHERE case_id = :case_id
