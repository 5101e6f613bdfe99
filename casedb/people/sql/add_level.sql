-- What somebody is from now on.
INSERT INTO person_level (person_id, since_us, level)
VALUES (:person_id, :since_us, :level)
