-- What consultants do on a task, with the numbers as they were when somebody set it: from there on it stays. A later
-- attempt, another level of a person or a new version of a metric makes no difference to it; a new standard may be
-- set beside it.
CREATE TABLE standard (
  standard_id TEXT NOT NULL PRIMARY KEY CHECK (length(standard_id) = 36),
  case_id TEXT NOT NULL REFERENCES training_case (case_id),
  lesion_id TEXT NOT NULL,
  picture_modality TEXT NOT NULL CHECK (picture_modality IN ('mpr', 'xray', 'ultrasound')),
  approach TEXT NOT NULL CHECK (approach IN ('in_plane', 'out_of_plane')),
  instrument_kind TEXT NOT NULL CHECK (instrument_kind IN ('access', 'core')),
  set_id TEXT NOT NULL CHECK (set_id <> ''), -- tells the attempts and the versions of metrics it was made of
  people INTEGER NOT NULL CHECK (people > 0),
  attempts INTEGER NOT NULL CHECK (attempts >= people),
  newest_us INTEGER NOT NULL, -- when the last of the attempts began
  set_by TEXT NOT NULL REFERENCES person (person_id),
  set_us INTEGER NOT NULL,
  FOREIGN KEY (lesion_id, case_id) REFERENCES lesion (lesion_id, case_id)
) STRICT;

-- Whose values it is made of; people are told by their attempts.
CREATE TABLE standard_attempt (
  standard_id TEXT NOT NULL REFERENCES standard (standard_id) ON DELETE CASCADE,
  attempt_id TEXT NOT NULL REFERENCES attempt (attempt_id) ON DELETE CASCADE,
  PRIMARY KEY (standard_id, attempt_id)
) STRICT, WITHOUT ROWID;

-- A band of one metric in one version (assessment/grading/standard.h).
CREATE TABLE standard_band (
  standard_id TEXT NOT NULL REFERENCES standard (standard_id) ON DELETE CASCADE,
  position INTEGER NOT NULL CHECK (position >= 0), -- order in which they are shown
  metric_id TEXT NOT NULL,
  version INTEGER NOT NULL CHECK (version > 0),
  unit TEXT NOT NULL,
  people INTEGER NOT NULL CHECK (people > 1), -- those who have a value
  low REAL NOT NULL,
  high REAL NOT NULL CHECK (high >= low),
  mean REAL NOT NULL,
  sd REAL NOT NULL CHECK (sd >= 0),
  tolerance_low REAL, -- both null: of a yes and no
  tolerance_high REAL CHECK (tolerance_high >= tolerance_low),
  PRIMARY KEY (standard_id, metric_id),
  CHECK ((tolerance_low IS NULL) = (tolerance_high IS NULL))
) STRICT, WITHOUT ROWID;

CREATE TRIGGER standard_is_immutable BEFORE UPDATE ON standard
BEGIN
  SELECT RAISE(ABORT, 'a standard cannot be changed: set another');
END;

CREATE TRIGGER standard_is_kept BEFORE DELETE ON standard
WHEN EXISTS (SELECT 1 FROM training_case WHERE training_case.case_id = OLD.case_id)
BEGIN
  SELECT RAISE(ABORT, 'a standard cannot be deleted');
END;

CREATE TRIGGER standard_attempt_is_immutable BEFORE UPDATE ON standard_attempt
BEGIN
  SELECT RAISE(ABORT, 'a standard cannot be changed: set another');
END;

CREATE TRIGGER standard_band_is_immutable BEFORE UPDATE ON standard_band
BEGIN
  SELECT RAISE(ABORT, 'a standard cannot be changed: set another');
END;

CREATE TRIGGER standard_band_is_kept BEFORE DELETE ON standard_band
WHEN EXISTS (SELECT 1 FROM standard WHERE standard.standard_id = OLD.standard_id)
BEGIN
  SELECT RAISE(ABORT, 'a standard cannot be changed: set another');
END;
