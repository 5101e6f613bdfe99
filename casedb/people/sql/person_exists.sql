-- Whether there is such a person, who has not been erased.
SELECT EXISTS (SELECT 1 FROM person WHERE person_id = :person_id AND erased_us IS NULL) AS found
