-- One account, and what its person is at :now_us.
SELECT person_id, role, password_hash, enabled, epoch, (
  SELECT level FROM person_level
  WHERE person_level.person_id = account.person_id AND since_us <= :now_us
  ORDER BY since_us DESC LIMIT 1) AS level
FROM account
WHERE person_id = :person_id
