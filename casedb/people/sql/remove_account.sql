-- Takes back add_account.
DELETE FROM account WHERE person_id = :person_id
