-- Whether there is such a person.
SELECT EXISTS (SELECT 1 FROM person WHERE person_id = :person_id) AS found
