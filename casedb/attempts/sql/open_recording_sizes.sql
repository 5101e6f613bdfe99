-- How many pieces the recording of each open attempt has so far.
SELECT open_attempt.attempt_id, (
  SELECT count(*) FROM open_chunk WHERE open_chunk.attempt_id = open_attempt.attempt_id
) AS recording_chunks
FROM open_attempt
ORDER BY open_attempt.attempt_id
