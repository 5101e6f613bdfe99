-- When somebody last tried a name that nobody has.
SELECT at_us FROM audit
WHERE act = 'log_in' AND object_id = ''
ORDER BY sequence DESC LIMIT 1
