-- What somebody decided about a version.
INSERT INTO case_decision (case_id, position, decision, person_id, note, decided_us)
SELECT :case_id, coalesce(max(position) + 1, 0), :decision, :person_id, :note, :decided_us FROM case_decision
WHERE case_id = :case_id
