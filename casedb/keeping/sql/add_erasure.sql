-- That something was erased, when, and by whom.
INSERT INTO erasure (erasure_id, what, erased_us, by_person_id)
VALUES (:erasure_id, :what, :erased_us, :by_person_id)
