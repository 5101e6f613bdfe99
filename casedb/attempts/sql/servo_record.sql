-- How the servo kept time in an attempt.
SELECT * FROM servo_record
WHERE attempt_id = :attempt_id
