-- When somebody was last let in again.
SELECT sequence FROM audit
WHERE act = 'let_in_again' AND object_id = :person_id AND result = 'done' AND at_us > :since_us AND at_us <= :now_us
ORDER BY sequence DESC LIMIT 1
