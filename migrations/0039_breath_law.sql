-- By which law a patient breathes, in which breath the CT was taken (docs/decisions/0084), and how deep breath may be.
-- Cases of before keep their law, and with it what their depth means; a new version of one takes the newest.
DROP TRIGGER training_case_keeps_its_motion;
ALTER TABLE training_case ADD COLUMN breath_law TEXT NOT NULL DEFAULT 'equal_holds'
  CHECK (breath_law IN ('equal_holds', 'drifting_holds'));
ALTER TABLE training_case ADD COLUMN ct_breath TEXT NOT NULL DEFAULT 'expiration'
  CHECK (ct_breath IN ('expiration', 'inspiration'));
ALTER TABLE training_case ADD COLUMN deeper_breath REAL NOT NULL DEFAULT 0.0
  CHECK (deeper_breath BETWEEN 0 AND 3); -- breaths of the law: 1 a quiet one, 3 a deep one; 0: none is shown
UPDATE training_case SET deeper_breath = breath_depth;
ALTER TABLE training_case DROP COLUMN breath_depth;
ALTER TABLE training_case RENAME COLUMN deeper_breath TO breath_depth;
-- Nobody has attempted a draft that can still be changed: it takes the newest, as deep downwards as before: a quiet
-- breath is 12 mm, and what was called one is 16.
UPDATE training_case SET breath_law = 'drifting_holds', breath_depth = breath_depth * 16.0 / 12.0
WHERE state = 'draft' AND NOT EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = training_case.case_id)
  AND NOT EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = training_case.case_id);

CREATE TRIGGER training_case_keeps_its_motion
BEFORE UPDATE OF breath_depth, breath_period_s, breath_irregularity, tissue_yields, breath_law, ct_breath ON training_case
WHEN OLD.state <> 'draft' OR EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = OLD.case_id)
  OR EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = OLD.case_id)
BEGIN
  SELECT RAISE(ABORT, 'only a draft without attempts is changed: make a new version');
END;
