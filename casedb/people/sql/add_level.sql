-- What somebody is from :now_us on. What a clock that was ahead said of the time to come never holds.
INSERT INTO person_level (person_id, since_us, level) VALUES (:person_id, :now_us, :level)
