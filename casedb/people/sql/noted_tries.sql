-- The operator's failures to log in as a person, newest first, with what ends their count.
SELECT at_us, result FROM audit
WHERE object_id = :person_id AND at_us > :since_us AND at_us <= :now_us
  AND (act = 'log_in' AND (result = 'done' OR actor = 'operator') OR act = 'let_in_again' AND result = 'done')
ORDER BY sequence DESC
