-- How many have begun to answer on pages.
SELECT count(*) AS begun FROM response_set
WHERE round_id = :round_id AND source = 'page'
