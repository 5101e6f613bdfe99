-- A round of ratings.
INSERT INTO rating_round (round_id, each, seed) VALUES (:round_id, :each, :seed)
