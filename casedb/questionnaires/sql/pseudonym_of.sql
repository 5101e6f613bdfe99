-- What somebody is called where nobody is named.
SELECT pseudonym FROM person WHERE person_id = :person_id
