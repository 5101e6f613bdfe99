-- When the last piece of an open attempt was stored, null where that is not known; no row: no such attempt.
SELECT away_s, (
  SELECT max(stored_us) FROM open_chunk WHERE open_chunk.attempt_id = open_attempt.attempt_id
) AS stored_us
FROM open_attempt
WHERE attempt_id = :attempt_id
