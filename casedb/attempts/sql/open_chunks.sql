-- The pieces of an open attempt's recording, in order.
SELECT sequence, checksum, data FROM open_chunk
WHERE attempt_id = :attempt_id
ORDER BY sequence
