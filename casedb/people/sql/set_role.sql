-- Another role, from now on; whoever is logged in is logged out.
UPDATE account SET role = :role, epoch = epoch + 1
WHERE person_id = :person_id
