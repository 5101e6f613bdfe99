-- A label map behind those there are.
INSERT INTO case_label_map (case_id, position, labels_sha256, created_us, wins)
SELECT :case_id, coalesce(max(position) + 1, 0), :labels_sha256, :created_us, 1 FROM case_label_map
WHERE case_id = :case_id
