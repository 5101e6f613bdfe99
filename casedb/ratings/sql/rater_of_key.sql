-- Whose bench a key opens.
SELECT round_id, rater FROM rating_rater WHERE key_hash = :key_hash
