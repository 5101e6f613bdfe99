-- How many people have begun to answer on pages, and who answers it at all: people, or simulated ones.
SELECT count(*) FILTER (WHERE source = 'page' AND simulated = 0) AS begun,
  count(*) FILTER (WHERE simulated = 0) AS of_people, count(*) FILTER (WHERE simulated = 1) AS simulated
FROM response_set
WHERE round_id = :round_id
