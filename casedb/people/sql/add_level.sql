-- What somebody is from now on, whatever a clock that was once ahead said before.
INSERT INTO person_level (person_id, since_us, level)
VALUES (:person_id, max(:since_us, coalesce(
  (SELECT max(since_us) + 1 FROM person_level WHERE person_id = :person_id), :since_us)), :level)
