-- Whether an account may log in.
UPDATE account SET enabled = :enabled
WHERE person_id = :person_id
