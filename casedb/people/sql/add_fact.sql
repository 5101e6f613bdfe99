-- What a person says of themselves, from now on.
INSERT INTO person_fact (person_id, fact_id, given_us, answer)
VALUES (:person_id, :fact_id, :given_us, :answer)
