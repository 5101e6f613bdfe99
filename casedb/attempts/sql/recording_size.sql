-- How many pieces an attempt's recording has.
SELECT recording_chunks FROM attempt
WHERE attempt_id = :attempt_id
