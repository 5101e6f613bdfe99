INSERT INTO cut (cut_id, case_id, metric_id, version, higher_is_better, method, options, data, value, low, high, n, words,
                 proposed_by, proposed_us)
VALUES (:cut_id, :case_id, :metric_id, :version, :higher_is_better, :method, :options, :data, :value, :low, :high, :n,
        :words, :proposed_by, :proposed_us)
