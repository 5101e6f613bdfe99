-- Organs slide along the trunk's wall (docs/decisions/0095): one law of breath more. The column is made anew, since its
-- CHECK names the laws. Cases of before keep theirs; a new version of one takes the newest.
DROP TRIGGER training_case_keeps_its_motion;

ALTER TABLE training_case ADD COLUMN newer_breath_law TEXT NOT NULL DEFAULT 'equal_holds'
  CHECK (newer_breath_law IN ('equal_holds', 'drifting_holds', 'sliding_organs'));
UPDATE training_case SET newer_breath_law = breath_law;
ALTER TABLE training_case DROP COLUMN breath_law;
ALTER TABLE training_case RENAME COLUMN newer_breath_law TO breath_law;
-- Nobody has attempted a draft that can still be changed: it takes the newest. A depth of either law is the same
-- breath; drafts of the oldest took the second with its migration, but one that was taken back since may not have.
UPDATE training_case SET breath_law = 'sliding_organs',
  breath_depth = min(3.0, breath_depth * CASE breath_law WHEN 'equal_holds' THEN 16.0 / 12.0 ELSE 1.0 END)
WHERE state = 'draft' AND NOT EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = training_case.case_id)
  AND NOT EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = training_case.case_id);

CREATE TRIGGER training_case_keeps_its_motion
BEFORE UPDATE OF breath_depth, breath_period_s, breath_irregularity, tissue_yields, breath_law, ct_breath ON training_case
WHEN OLD.state <> 'draft' OR EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = OLD.case_id)
  OR EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = OLD.case_id)
BEGIN
  SELECT RAISE(ABORT, 'only a draft without attempts is changed: make a new version');
END;
