-- Cases and attempts guided by ultrasound.

-- Modalities stand in CHECKs, which SQLite changes only with a new table. As in 0002: rows go to a copy and back, and
-- the references to them are looked at when all is there again, at the commit.
PRAGMA defer_foreign_keys = ON;
DROP VIEW attempt_summary;
CREATE TEMPORARY TABLE training_case_before AS SELECT * FROM training_case;
CREATE TEMPORARY TABLE attempt_before AS SELECT * FROM attempt;
DROP TABLE attempt;
DROP TABLE training_case;

CREATE TABLE training_case (
  case_id TEXT NOT NULL PRIMARY KEY CHECK (length(case_id) = 36),
  title TEXT NOT NULL, -- given by a person, never by the source
  state TEXT NOT NULL CHECK (state IN ('draft', 'review', 'published', 'retired')),
  origin TEXT NOT NULL CHECK (origin = 'import' OR origin LIKE 'phantom:%'),
  created_us INTEGER NOT NULL,
  size_x_voxels INTEGER NOT NULL CHECK (size_x_voxels > 0),
  size_y_voxels INTEGER NOT NULL CHECK (size_y_voxels > 0),
  size_z_voxels INTEGER NOT NULL CHECK (size_z_voxels > 0),
  spacing_x_mm REAL NOT NULL CHECK (spacing_x_mm > 0),
  spacing_y_mm REAL NOT NULL CHECK (spacing_y_mm > 0),
  spacing_z_mm REAL NOT NULL CHECK (spacing_z_mm > 0),
  -- mm from voxel index, of voxel centres: row and column from 0; the last row is 0 0 0 1
  lps_from_voxel_00 REAL NOT NULL,
  lps_from_voxel_01 REAL NOT NULL,
  lps_from_voxel_02 REAL NOT NULL,
  lps_from_voxel_03 REAL NOT NULL,
  lps_from_voxel_10 REAL NOT NULL,
  lps_from_voxel_11 REAL NOT NULL,
  lps_from_voxel_12 REAL NOT NULL,
  lps_from_voxel_13 REAL NOT NULL,
  lps_from_voxel_20 REAL NOT NULL,
  lps_from_voxel_21 REAL NOT NULL,
  lps_from_voxel_22 REAL NOT NULL,
  lps_from_voxel_23 REAL NOT NULL,
  hu_min INTEGER NOT NULL,
  hu_max INTEGER NOT NULL CHECK (hu_max >= hu_min),
  slices_used INTEGER NOT NULL CHECK (slices_used >= 0),
  -- names of files in assets/
  volume_sha256 TEXT NOT NULL CHECK (length(volume_sha256) = 64),
  skin_sha256 TEXT NOT NULL CHECK (length(skin_sha256) = 64),
  labels_sha256 TEXT CHECK (length(labels_sha256) = 64), -- null: no labels
  modality TEXT NOT NULL DEFAULT 'mpr' CHECK (modality IN ('mpr', 'xray', 'ultrasound')), -- what it is practised with
  patient_position TEXT NOT NULL DEFAULT 'supine' CHECK (patient_position IN ('supine', 'prone')),
  classes_sha256 TEXT CHECK (length(classes_sha256) = 64) -- null: from before schema 3
) STRICT;

-- What an attempt was made on stays as it was; title and state may change.
CREATE TRIGGER training_case_keeps_its_data
BEFORE UPDATE OF case_id, origin, created_us, size_x_voxels, size_y_voxels, size_z_voxels, spacing_x_mm, spacing_y_mm,
  spacing_z_mm, lps_from_voxel_00, lps_from_voxel_01, lps_from_voxel_02, lps_from_voxel_03, lps_from_voxel_10,
  lps_from_voxel_11, lps_from_voxel_12, lps_from_voxel_13, lps_from_voxel_20, lps_from_voxel_21, lps_from_voxel_22,
  lps_from_voxel_23, hu_min, hu_max, slices_used, volume_sha256, skin_sha256, labels_sha256
ON training_case
BEGIN
  SELECT RAISE(ABORT, 'the data of a case cannot be changed');
END;

-- A replay needs both as they were.
CREATE TRIGGER training_case_keeps_its_guidance BEFORE UPDATE OF modality, patient_position ON training_case
BEGIN
  SELECT RAISE(ABORT, 'the guidance of a case cannot be changed');
END;

CREATE TRIGGER training_case_keeps_its_classes BEFORE UPDATE OF classes_sha256 ON training_case
BEGIN
  SELECT RAISE(ABORT, 'the tissue classes of a case cannot be changed');
END;

INSERT INTO training_case SELECT * FROM temp.training_case_before;
DROP TABLE temp.training_case_before;

CREATE TABLE attempt (
  attempt_id TEXT NOT NULL PRIMARY KEY CHECK (length(attempt_id) = 36),
  case_id TEXT NOT NULL REFERENCES training_case (case_id),
  lesion_id TEXT NOT NULL,
  person_id TEXT REFERENCES person (person_id), -- null: a simulation of nobody
  operator_name TEXT NOT NULL, -- 'person', or the simulated operator
  seed INTEGER NOT NULL, -- the 64 bits of an unsigned number, read as a signed one
  program_version TEXT NOT NULL,
  step_version INTEGER NOT NULL CHECK (step_version >= 0), -- replay needs the same
  approach TEXT NOT NULL CHECK (approach IN ('in_plane', 'out_of_plane')),
  instrument_kind TEXT NOT NULL CHECK (instrument_kind IN ('access', 'core')),
  instrument_length_mm REAL NOT NULL,
  instrument_radius_mm REAL NOT NULL,
  instrument_inner_radius_mm REAL NOT NULL, -- 0: solid
  instrument_hu REAL NOT NULL,
  instrument_throw_mm REAL NOT NULL,
  instrument_notch_mm REAL NOT NULL,
  instrument_dead_tip_mm REAL NOT NULL,
  picture_modality TEXT NOT NULL CHECK (picture_modality IN ('mpr', 'xray', 'ultrasound')),
  picture_depth_mm REAL NOT NULL,
  picture_width_mm REAL NOT NULL,
  picture_rate_hz REAL NOT NULL,
  started_us INTEGER NOT NULL,
  duration_s REAL NOT NULL CHECK (duration_s >= 0),
  state TEXT NOT NULL CHECK (state IN ('complete', 'unfinished')), -- complete: the trigger fell
  recording_chunks INTEGER NOT NULL CHECK (recording_chunks > 0), -- how many belong to it
  picture_sha256 TEXT CHECK (length(picture_sha256) = 64), -- PNG in assets/ at the trigger; null: none
  picture_probe TEXT, -- of ultrasound; null: another modality
  FOREIGN KEY (lesion_id, case_id) REFERENCES lesion (lesion_id, case_id)
) STRICT;

CREATE INDEX attempt_by_time ON attempt (started_us, attempt_id);
CREATE INDEX attempt_by_person ON attempt (person_id, started_us, attempt_id);
CREATE INDEX attempt_by_case ON attempt (case_id);

CREATE TRIGGER attempt_is_immutable BEFORE UPDATE ON attempt
BEGIN
  SELECT RAISE(ABORT, 'an attempt cannot be changed');
END;

CREATE TRIGGER attempt_is_kept BEFORE DELETE ON attempt
BEGIN
  SELECT RAISE(ABORT, 'an attempt cannot be deleted');
END;

INSERT INTO attempt SELECT *, NULL FROM temp.attempt_before;
DROP TABLE temp.attempt_before;

-- An attempt with what every list of attempts shows.
CREATE VIEW attempt_summary AS
SELECT attempt.*, training_case.title AS case_title, lesion.center_x_lps_mm, lesion.center_y_lps_mm,
  lesion.center_z_lps_mm, lesion.radius_mm, lesion.hu AS lesion_hu
FROM attempt
JOIN training_case ON training_case.case_id = attempt.case_id
JOIN lesion ON lesion.lesion_id = attempt.lesion_id;
