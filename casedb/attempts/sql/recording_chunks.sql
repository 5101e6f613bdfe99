-- The pieces of an attempt's recording, in order.
SELECT sequence, checksum, data FROM recording_chunk
WHERE attempt_id = :attempt_id
ORDER BY sequence
