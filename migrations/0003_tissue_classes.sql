-- Tissue classes beside the volume.

-- A file of assets/. Null in cases of before: theirs are computed from volume and labels when they are asked for.
ALTER TABLE training_case ADD COLUMN classes_sha256 TEXT CHECK (length(classes_sha256) = 64);

CREATE TRIGGER training_case_keeps_its_classes BEFORE UPDATE OF classes_sha256 ON training_case
BEGIN
  SELECT RAISE(ABORT, 'the tissue classes of a case cannot be changed');
END;
