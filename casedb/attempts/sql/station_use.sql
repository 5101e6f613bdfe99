-- What the people whose ids stand in the JSON list :people did at each station, '' where it was not recorded, and,
-- apart from that, what was simulated there.
SELECT coalesce(words, '') AS station, operator_name <> 'person' AS simulated, count(*) AS attempts,
  count(DISTINCT person_id) AS people, count(DISTINCT started_us / 86400000000) AS days,
  sum(duration_s) AS duration_s, max(started_us) AS last_us
FROM attempt
LEFT JOIN attempt_condition
  ON attempt_condition.attempt_id = attempt.attempt_id AND condition_id = 'station'
WHERE person_id IN (SELECT value FROM json_each(:people))
GROUP BY station, simulated
ORDER BY station, simulated
