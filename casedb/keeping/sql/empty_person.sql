-- An empty row is left of a person; not even the pseudonym stays.
UPDATE person SET pseudonym = :pseudonym, erased_us = :erased_us
WHERE person_id = :person_id
