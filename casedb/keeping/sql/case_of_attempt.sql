-- On which case an attempt was made.
SELECT case_id FROM attempt WHERE attempt_id = :attempt_id
