-- Every answer of a person, oldest first.
SELECT fact_id, given_us, answer FROM person_fact
WHERE person_id = :person_id
ORDER BY given_us, fact_id
