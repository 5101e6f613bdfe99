-- How servo and screen kept time in the newest :count attempts in real time at each station.
SELECT station, servo_record.*,
  (SELECT number FROM attempt_condition AS had
   WHERE had.attempt_id = newest.attempt_id AND condition_id = 'window_rate_hz') AS window_hz,
  (SELECT number FROM attempt_condition AS had
   WHERE had.attempt_id = newest.attempt_id AND condition_id = 'picture_rate_hz_shown') AS picture_hz,
  (SELECT words FROM attempt_condition AS had
   WHERE had.attempt_id = newest.attempt_id AND condition_id = 'picture_method') AS picture_method,
  (SELECT number FROM attempt_condition AS had
   WHERE had.attempt_id = newest.attempt_id AND condition_id = 'speckle_fallback') AS speckle_fallback
FROM (
  SELECT attempt.attempt_id, coalesce(words, '') AS station,
    row_number() OVER (PARTITION BY words ORDER BY started_us DESC, attempt.attempt_id DESC) AS place
  FROM attempt
  JOIN servo_record ON servo_record.attempt_id = attempt.attempt_id
  LEFT JOIN attempt_condition
    ON attempt_condition.attempt_id = attempt.attempt_id AND condition_id = 'station'
) AS newest
JOIN servo_record ON servo_record.attempt_id = newest.attempt_id
WHERE place <= :count
ORDER BY station, place
