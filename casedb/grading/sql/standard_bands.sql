SELECT metric_id, version, unit, people, low, high, mean, sd, tolerance_low, tolerance_high
FROM standard_band WHERE standard_id = :standard_id
ORDER BY position
