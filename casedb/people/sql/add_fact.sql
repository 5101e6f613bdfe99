-- What a person says of themselves, from now on, whatever a clock that was once ahead said before.
INSERT INTO person_fact (person_id, fact_id, given_us, answer)
VALUES (:person_id, :fact_id, max(:given_us, coalesce(
  (SELECT max(given_us) + 1 FROM person_fact WHERE person_id = :person_id AND fact_id = :fact_id), :given_us)), :answer)
