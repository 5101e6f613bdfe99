-- Every account, oldest first, and what its person is now.
SELECT person_id, role, password_hash, enabled, epoch, (
  SELECT level FROM person_level
  WHERE person_level.person_id = account.person_id
  ORDER BY since_us DESC LIMIT 1) AS level
FROM account
ORDER BY created_us, person_id
