-- Whether an account may log in; what was begun before a change is over.
UPDATE account SET enabled = :enabled, epoch = epoch + (enabled <> :enabled)
WHERE person_id = :person_id
