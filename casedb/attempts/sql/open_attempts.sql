-- Every open attempt, oldest first, and how many pieces of it there are.
SELECT open_attempt.*,
  (SELECT count(*) FROM open_chunk WHERE open_chunk.attempt_id = open_attempt.attempt_id) AS chunks
FROM open_attempt
ORDER BY started_us, attempt_id
