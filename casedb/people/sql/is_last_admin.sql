-- Whether nobody else is an admin whose account is open.
SELECT count(*) FILTER (WHERE person_id = :person_id) = 1 AND count(*) = 1 AS last FROM account
WHERE role = 'admin' AND enabled = 1
