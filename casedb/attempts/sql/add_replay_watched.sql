-- Somebody watches a stored attempt.
INSERT INTO replay_watched (person_id, attempt_id, watched_us)
VALUES (:person_id, :attempt_id, :watched_us)
ON CONFLICT DO NOTHING
