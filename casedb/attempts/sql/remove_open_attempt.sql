-- An open attempt and its pieces, once it is an attempt.
DELETE FROM open_attempt
WHERE attempt_id = :attempt_id
