-- How a round is rated.
SELECT each, seed FROM rating_round WHERE round_id = :round_id
