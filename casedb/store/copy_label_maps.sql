-- Label maps, for a new version.
INSERT INTO case_label_map (case_id, position, labels_sha256, created_us)
SELECT :case_id, position, labels_sha256, created_us FROM case_label_map
WHERE case_id = :from_case_id
