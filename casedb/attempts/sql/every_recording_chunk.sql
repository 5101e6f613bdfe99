-- The pieces of every attempt's recording, in order.
SELECT attempt_id, sequence, checksum, data FROM recording_chunk
ORDER BY attempt_id, sequence
