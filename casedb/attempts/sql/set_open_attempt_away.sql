-- For how long nobody was at an open attempt.
UPDATE open_attempt SET away_s = :away_s
WHERE attempt_id = :attempt_id
