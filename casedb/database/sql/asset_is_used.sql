-- Whether a file of assets/ belongs to a case, an attempt or what raters see of one.
SELECT EXISTS (
  SELECT 1 FROM training_case WHERE :sha256 IN (volume_sha256, skin_sha256, labels_sha256, classes_sha256)
) OR EXISTS (
  SELECT 1 FROM case_preparation WHERE original_sha256 = :sha256
) OR EXISTS (
  SELECT 1 FROM case_label_map WHERE labels_sha256 = :sha256
) OR EXISTS (
  SELECT 1 FROM structure WHERE labels_sha256 = :sha256
) OR EXISTS (
  SELECT 1 FROM attempt WHERE picture_sha256 = :sha256
) OR EXISTS (
  SELECT 1 FROM rating_view WHERE sheet_sha256 = :sha256
) AS used
