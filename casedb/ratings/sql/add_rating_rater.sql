-- Somebody who rates, known by a key.
INSERT INTO rating_rater (round_id, rater, key_hash) VALUES (:round_id, :rater, :key_hash)
