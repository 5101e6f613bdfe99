-- The newest :count attempts at each station, and apart from them the simulated ones, of the people whose ids stand in
-- the JSON list :people, with the newest version of two metrics.
SELECT station, simulated, duration_s,
  (SELECT value FROM metric_value WHERE metric_value.attempt_id = newest.attempt_id AND metric_id = 'tip_target_dist'
   ORDER BY version DESC LIMIT 1) AS target_mm,
  (SELECT value FROM metric_value WHERE metric_value.attempt_id = newest.attempt_id AND metric_id = 'hit'
   ORDER BY version DESC LIMIT 1) AS hit
FROM (
  SELECT attempt.attempt_id, started_us, duration_s, coalesce(words, '') AS station,
    operator_name <> 'person' AS simulated,
    row_number() OVER (PARTITION BY words, operator_name <> 'person'
      ORDER BY started_us DESC, attempt.attempt_id DESC) AS place
  FROM attempt
  LEFT JOIN attempt_condition
    ON attempt_condition.attempt_id = attempt.attempt_id AND condition_id = 'station'
  WHERE person_id IN (SELECT value FROM json_each(:people))
) AS newest
WHERE place <= :count
ORDER BY station, simulated, place
