-- Cases and attempts guided by fluoroscopy.

-- What a case is practised with, and how its patient lies on the table. Cases of before are slices under a probe.
ALTER TABLE training_case ADD COLUMN modality TEXT NOT NULL DEFAULT 'mpr' CHECK (modality IN ('mpr', 'xray'));
ALTER TABLE training_case ADD COLUMN patient_position TEXT NOT NULL DEFAULT 'supine'
  CHECK (patient_position IN ('supine', 'prone'));

-- A replay needs both as they were.
CREATE TRIGGER training_case_keeps_its_guidance BEFORE UPDATE OF modality, patient_position ON training_case
BEGIN
  SELECT RAISE(ABORT, 'the guidance of a case cannot be changed');
END;

-- attempt.picture_modality takes 'xray' too. SQLite changes a CHECK only with a new table: the rows go to a copy and
-- back, and the references to them are looked at when all is there again, at the commit. The copy is a temporary one,
-- so that it leaves no hole in the file.
PRAGMA defer_foreign_keys = ON;
DROP VIEW attempt_summary;
CREATE TEMPORARY TABLE attempt_before AS SELECT * FROM attempt;
DROP TABLE attempt;

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
  picture_modality TEXT NOT NULL CHECK (picture_modality IN ('mpr', 'xray')),
  picture_depth_mm REAL NOT NULL,
  picture_width_mm REAL NOT NULL,
  picture_rate_hz REAL NOT NULL,
  started_us INTEGER NOT NULL,
  duration_s REAL NOT NULL CHECK (duration_s >= 0),
  state TEXT NOT NULL CHECK (state IN ('complete', 'unfinished')), -- complete: the trigger fell
  recording_chunks INTEGER NOT NULL CHECK (recording_chunks > 0), -- how many belong to it
  picture_sha256 TEXT CHECK (length(picture_sha256) = 64), -- PNG in assets/ at the trigger; null: none
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

INSERT INTO attempt SELECT * FROM temp.attempt_before;
DROP TABLE temp.attempt_before;

-- An attempt with what every list of attempts shows.
CREATE VIEW attempt_summary AS
SELECT attempt.*, training_case.title AS case_title, lesion.center_x_lps_mm, lesion.center_y_lps_mm,
  lesion.center_z_lps_mm, lesion.radius_mm, lesion.hu AS lesion_hu
FROM attempt
JOIN training_case ON training_case.case_id = attempt.case_id
JOIN lesion ON lesion.lesion_id = attempt.lesion_id;
