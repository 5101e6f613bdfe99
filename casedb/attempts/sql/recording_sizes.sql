-- How many pieces the recording of each attempt has.
SELECT attempt_id, recording_chunks FROM attempt
ORDER BY attempt_id
