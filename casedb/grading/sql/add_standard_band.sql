INSERT INTO standard_band (standard_id, position, metric_id, version, unit, people, low, high, mean, sd,
                           tolerance_low, tolerance_high)
VALUES (:standard_id, :position, :metric_id, :version, :unit, :people, :low, :high, :mean, :sd, :tolerance_low,
        :tolerance_high)
