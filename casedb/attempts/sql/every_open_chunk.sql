-- The pieces of every open attempt's recording, in order.
SELECT attempt_id, sequence, checksum, data FROM open_chunk
ORDER BY attempt_id, sequence
