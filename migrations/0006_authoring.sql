-- What a mentor makes of a case: lesions of any shape, structures, the setting of an attempt, and versions with who
-- decided what about them.

-- --- lesions (sim/case/lesion_form.h) ---
ALTER TABLE lesion ADD COLUMN kind TEXT NOT NULL DEFAULT 'sphere'
  CHECK (kind IN ('sphere', 'ellipsoid', 'irregular')); -- radius_mm: of an ellipsoid, of the ball of its volume
ALTER TABLE lesion ADD COLUMN radius_x_mm REAL CHECK ((kind = 'ellipsoid') = (coalesce(radius_x_mm, 0) > 0));
ALTER TABLE lesion ADD COLUMN radius_y_mm REAL CHECK ((kind = 'ellipsoid') = (coalesce(radius_y_mm, 0) > 0));
ALTER TABLE lesion ADD COLUMN radius_z_mm REAL CHECK ((kind = 'ellipsoid') = (coalesce(radius_z_mm, 0) > 0));
ALTER TABLE lesion ADD COLUMN roughness REAL NOT NULL DEFAULT 0.0 CHECK (roughness >= 0); -- irregular
ALTER TABLE lesion ADD COLUMN seed INTEGER NOT NULL DEFAULT 1; -- irregular; 64 bits as in attempt.seed
ALTER TABLE lesion ADD COLUMN adds INTEGER NOT NULL DEFAULT 0 CHECK (adds IN (0, 1)); -- hu is added to the tissue
ALTER TABLE lesion ADD COLUMN edge_mm REAL NOT NULL DEFAULT 0.0 CHECK (edge_mm >= 0);

-- --- the setting ---
-- A position on the side is new: the column is made again, since SQLite changes no CHECK.
DROP TRIGGER training_case_keeps_its_guidance;
CREATE TEMPORARY TABLE position_before AS SELECT case_id, patient_position FROM training_case;
ALTER TABLE training_case DROP COLUMN patient_position;
ALTER TABLE training_case ADD COLUMN patient_position TEXT NOT NULL DEFAULT 'supine'
  CHECK (patient_position IN ('supine', 'prone', 'lateral_left', 'lateral_right'));
UPDATE training_case SET patient_position =
  (SELECT patient_position FROM temp.position_before WHERE position_before.case_id = training_case.case_id);
DROP TABLE temp.position_before;
ALTER TABLE training_case ADD COLUMN further_modalities TEXT NOT NULL DEFAULT ''; -- beside `modality`, with commas
ALTER TABLE training_case ADD COLUMN approach TEXT NOT NULL DEFAULT 'in_plane'
  CHECK (approach IN ('in_plane', 'out_of_plane'));
ALTER TABLE training_case ADD COLUMN instrument_kind TEXT NOT NULL DEFAULT 'access'
  CHECK (instrument_kind IN ('access', 'core'));
ALTER TABLE training_case ADD COLUMN instrument_length_mm REAL NOT NULL DEFAULT 200.0 CHECK (instrument_length_mm > 0);
ALTER TABLE training_case ADD COLUMN instrument_radius_mm REAL NOT NULL DEFAULT 0.36 CHECK (instrument_radius_mm > 0);
ALTER TABLE training_case ADD COLUMN instrument_inner_radius_mm REAL NOT NULL DEFAULT 0.0; -- 0: solid
ALTER TABLE training_case ADD COLUMN instrument_hu REAL NOT NULL DEFAULT 3000.0;
ALTER TABLE training_case ADD COLUMN instrument_throw_mm REAL NOT NULL DEFAULT 22.0 CHECK (instrument_throw_mm >= 0);
ALTER TABLE training_case ADD COLUMN instrument_notch_mm REAL NOT NULL DEFAULT 18.0 CHECK (instrument_notch_mm >= 0);
ALTER TABLE training_case ADD COLUMN instrument_dead_tip_mm REAL NOT NULL DEFAULT 4.0
  CHECK (instrument_dead_tip_mm >= 0);
ALTER TABLE training_case ADD COLUMN inr REAL CHECK (inr > 0); -- null: not known
ALTER TABLE training_case ADD COLUMN platelets_per_nl REAL CHECK (platelets_per_nl >= 0); -- 10⁹/l; null: not known
ALTER TABLE training_case ADD COLUMN allergy TEXT NOT NULL DEFAULT '';
ALTER TABLE training_case ADD COLUMN indication TEXT NOT NULL DEFAULT '';
ALTER TABLE training_case ADD COLUMN decision TEXT NOT NULL DEFAULT 'proceed' CHECK (decision IN ('proceed', 'defer'));
ALTER TABLE training_case ADD COLUMN planned_entry_x_lps_mm REAL; -- all three or none
ALTER TABLE training_case ADD COLUMN planned_entry_y_lps_mm REAL;
ALTER TABLE training_case ADD COLUMN planned_entry_z_lps_mm REAL
  CHECK ((planned_entry_x_lps_mm IS NULL) = (planned_entry_z_lps_mm IS NULL)
    AND (planned_entry_y_lps_mm IS NULL) = (planned_entry_z_lps_mm IS NULL));
ALTER TABLE training_case ADD COLUMN difficulty TEXT NOT NULL DEFAULT 'moderate'
  CHECK (difficulty IN ('easy', 'moderate', 'hard'));
ALTER TABLE training_case ADD COLUMN time_limit_s REAL CHECK (time_limit_s > 0); -- null: none
ALTER TABLE training_case ADD COLUMN attempt_limit INTEGER CHECK (attempt_limit BETWEEN 1 AND 1000); -- null: none
ALTER TABLE training_case ADD COLUMN pass_rule TEXT CHECK (pass_rule <> ''); -- assessment/grading/rule_json.h

-- --- versions ---
-- The case_id of version 1, which need not be in this library; null: this is it.
ALTER TABLE training_case ADD COLUMN family_id TEXT CHECK (length(family_id) = 36);
ALTER TABLE training_case ADD COLUMN version INTEGER NOT NULL DEFAULT 1
  CHECK (version BETWEEN 1 AND 1000000 AND (version = 1) = (family_id IS NULL));
ALTER TABLE training_case ADD COLUMN audience TEXT NOT NULL DEFAULT 'everyone'
  CHECK (audience IN ('everyone', 'own_cohort')); -- of a published one; own_cohort: no second person has reviewed it

CREATE UNIQUE INDEX training_case_version ON training_case (coalesce(family_id, case_id), version);

-- Who decided what about a version, in order.
CREATE TABLE case_decision (
  case_id TEXT NOT NULL REFERENCES training_case (case_id),
  position INTEGER NOT NULL CHECK (position >= 0),
  decision TEXT NOT NULL CHECK (decision IN ('made', 'submitted', 'returned', 'approved', 'published', 'retired')),
  person_id TEXT NOT NULL REFERENCES person (person_id),
  note TEXT NOT NULL,
  decided_us INTEGER NOT NULL,
  PRIMARY KEY (case_id, position)
) STRICT;

CREATE TRIGGER case_decision_is_immutable BEFORE UPDATE ON case_decision
BEGIN
  SELECT RAISE(ABORT, 'a decision cannot be changed');
END;

CREATE TRIGGER case_decision_is_kept BEFORE DELETE ON case_decision
BEGIN
  SELECT RAISE(ABORT, 'a decision cannot be deleted');
END;

-- --- structures ---
-- Label maps that came after the case; a structure may be one of their labels.
CREATE TABLE case_label_map (
  case_id TEXT NOT NULL REFERENCES training_case (case_id),
  position INTEGER NOT NULL CHECK (position >= 0),
  labels_sha256 TEXT NOT NULL CHECK (length(labels_sha256) = 64), -- a file of assets/
  created_us INTEGER NOT NULL,
  PRIMARY KEY (case_id, position),
  UNIQUE (case_id, labels_sha256)
) STRICT;

CREATE TABLE structure (
  structure_id TEXT NOT NULL PRIMARY KEY CHECK (length(structure_id) = 36),
  case_id TEXT NOT NULL REFERENCES training_case (case_id),
  position INTEGER NOT NULL CHECK (position >= 0), -- later ones are painted over earlier ones
  title TEXT NOT NULL CHECK (title <> ''),
  rule TEXT NOT NULL CHECK (rule IN ('advisory', 'major', 'critical', 'must_cross', 'organ', 'target')),
  tissue TEXT NOT NULL CHECK (tissue <> ''),
  kind TEXT NOT NULL CHECK (kind IN ('class', 'label', 'drawn')),
  geometry TEXT CHECK (geometry <> ''), -- drawn: casedb/structure_json.h
  hu REAL, -- drawn: what is painted; null: what the CT says stays
  labels_sha256 TEXT CHECK (length(labels_sha256) = 64), -- label: the case's own map or one of case_label_map
  label INTEGER CHECK (label BETWEEN 1 AND 255),
  created_us INTEGER NOT NULL,
  UNIQUE (case_id, position),
  UNIQUE (case_id, title),
  CHECK ((kind = 'drawn') = (geometry IS NOT NULL) AND (kind = 'drawn' OR hu IS NULL)),
  CHECK ((kind = 'label') = (labels_sha256 IS NOT NULL) AND (kind = 'label') = (label IS NOT NULL))
) STRICT;

-- --- what stays as it was ---
-- A case goes from draft to review and back, is published, is retired: never back from there.
CREATE TRIGGER training_case_goes_forward BEFORE UPDATE OF state ON training_case
WHEN (OLD.state = 'published' AND NEW.state NOT IN ('published', 'retired'))
  OR (OLD.state = 'retired' AND NEW.state <> 'retired')
BEGIN
  SELECT RAISE(ABORT, 'a published case is not changed: make a new version');
END;

CREATE TRIGGER training_case_published_is_kept BEFORE DELETE ON training_case WHEN OLD.state = 'published'
BEGIN
  SELECT RAISE(ABORT, 'a published case is retired, not deleted');
END;

CREATE TRIGGER training_case_keeps_its_place BEFORE UPDATE OF family_id, version ON training_case
BEGIN
  SELECT RAISE(ABORT, 'the version of a case cannot be changed');
END;

CREATE TRIGGER training_case_published_keeps_its_name BEFORE UPDATE OF title, audience ON training_case
WHEN OLD.state IN ('published', 'retired') AND (OLD.title <> NEW.title OR OLD.audience <> NEW.audience)
BEGIN
  SELECT RAISE(ABORT, 'a published case is not changed: make a new version');
END;

-- Also from the first attempt on: a score and a replay need the setting as it was.
CREATE TRIGGER training_case_keeps_its_setting
BEFORE UPDATE OF modality, patient_position, further_modalities, approach, instrument_kind, instrument_length_mm,
  instrument_radius_mm, instrument_inner_radius_mm, instrument_hu, instrument_throw_mm, instrument_notch_mm,
  instrument_dead_tip_mm, inr, platelets_per_nl, allergy, indication, decision, planned_entry_x_lps_mm,
  planned_entry_y_lps_mm, planned_entry_z_lps_mm, difficulty, time_limit_s, attempt_limit, pass_rule
ON training_case
WHEN OLD.state <> 'draft' OR EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = OLD.case_id)
  OR EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = OLD.case_id)
BEGIN
  SELECT RAISE(ABORT, 'only a draft without attempts is changed: make a new version');
END;

CREATE TRIGGER lesion_comes_to_a_draft BEFORE INSERT ON lesion
WHEN (SELECT state FROM training_case WHERE training_case.case_id = NEW.case_id) <> 'draft'
BEGIN
  SELECT RAISE(ABORT, 'only a draft is changed: make a new version');
END;

CREATE TRIGGER lesion_leaves_a_draft BEFORE DELETE ON lesion
WHEN (SELECT state FROM training_case WHERE training_case.case_id = OLD.case_id) <> 'draft'
BEGIN
  SELECT RAISE(ABORT, 'only a draft is changed: make a new version');
END;

CREATE TRIGGER structure_is_immutable BEFORE UPDATE ON structure
BEGIN
  SELECT RAISE(ABORT, 'a structure cannot be changed');
END;

CREATE TRIGGER structure_comes_to_a_draft BEFORE INSERT ON structure
WHEN (SELECT state FROM training_case WHERE training_case.case_id = NEW.case_id) <> 'draft'
  OR EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = NEW.case_id)
  OR EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = NEW.case_id)
BEGIN
  SELECT RAISE(ABORT, 'only a draft without attempts is changed: make a new version');
END;

CREATE TRIGGER structure_leaves_a_draft BEFORE DELETE ON structure
WHEN (SELECT state FROM training_case WHERE training_case.case_id = OLD.case_id) <> 'draft'
  OR EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = OLD.case_id)
  OR EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = OLD.case_id)
BEGIN
  SELECT RAISE(ABORT, 'only a draft without attempts is changed: make a new version');
END;
