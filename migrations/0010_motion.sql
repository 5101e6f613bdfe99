-- What of a case's patient moves. Cases of before lie as still as their CT.
ALTER TABLE training_case ADD COLUMN breath_depth REAL NOT NULL DEFAULT 0.0
  CHECK (breath_depth BETWEEN 0 AND 2); -- a share of a quiet breath of the liver (sim/case/breathing.h); 0: none is shown
ALTER TABLE training_case ADD COLUMN breath_period_s REAL NOT NULL DEFAULT 4.0 CHECK (breath_period_s BETWEEN 1 AND 20);
ALTER TABLE training_case ADD COLUMN breath_irregularity REAL NOT NULL DEFAULT 0.1
  CHECK (breath_irregularity BETWEEN 0 AND 0.4);
ALTER TABLE training_case ADD COLUMN tissue_yields INTEGER NOT NULL DEFAULT 0 CHECK (tissue_yields IN (0, 1));

CREATE TRIGGER training_case_keeps_its_motion
BEFORE UPDATE OF breath_depth, breath_period_s, breath_irregularity, tissue_yields ON training_case
WHEN OLD.state <> 'draft' OR EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = OLD.case_id)
  OR EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = OLD.case_id)
BEGIN
  SELECT RAISE(ABORT, 'only a draft without attempts is changed: make a new version');
END;
