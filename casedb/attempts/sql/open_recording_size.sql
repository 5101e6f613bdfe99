-- How many pieces of an open attempt there are; no row: no such attempt.
SELECT (SELECT count(*) FROM open_chunk WHERE open_chunk.attempt_id = open_attempt.attempt_id) AS chunks
FROM open_attempt
WHERE attempt_id = :attempt_id
