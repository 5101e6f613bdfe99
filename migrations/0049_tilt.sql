-- A needle's tip fades with its tilt as its shaft does (docs/decisions/0106): one law of sight more. The column is made
-- anew, since its CHECK names the laws. Cases of before keep theirs; a new version of one takes the newest.
DROP TRIGGER training_case_keeps_its_sight_law;

ALTER TABLE training_case ADD COLUMN newer_sight_law TEXT NOT NULL DEFAULT 'half_slice'
  CHECK (newer_sight_law IN ('half_slice', 'echo', 'scatter', 'clutter', 'material', 'tilt'));
UPDATE training_case SET newer_sight_law = sight_law;
ALTER TABLE training_case DROP COLUMN sight_law;
ALTER TABLE training_case RENAME COLUMN newer_sight_law TO sight_law;
-- Nobody has attempted a draft that can still be changed: it takes the newest.
UPDATE training_case SET sight_law = 'tilt'
WHERE state = 'draft' AND NOT EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = training_case.case_id)
  AND NOT EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = training_case.case_id);

CREATE TRIGGER training_case_keeps_its_sight_law
BEFORE UPDATE OF sight_law ON training_case
WHEN OLD.state <> 'draft' OR EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = OLD.case_id)
  OR EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = OLD.case_id)
BEGIN
  SELECT RAISE(ABORT, 'only a draft without attempts is changed: make a new version');
END;
