-- The form of a needle's tip, and by which law touch follows (docs/decisions/0088). Cases of before keep theirs; a new
-- version of one takes the newest.
ALTER TABLE training_case ADD COLUMN instrument_tip TEXT NOT NULL DEFAULT 'bevel'
  CHECK (instrument_tip IN ('bevel', 'diamond', 'trocar', 'core'));
ALTER TABLE training_case ADD COLUMN touch_law TEXT NOT NULL DEFAULT 'steady'
  CHECK (touch_law IN ('steady', 'by_speed'));
-- Nobody has attempted a draft that can still be changed: it takes the newest.
UPDATE training_case SET touch_law = 'by_speed'
WHERE state = 'draft' AND NOT EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = training_case.case_id)
  AND NOT EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = training_case.case_id);

CREATE TRIGGER training_case_keeps_its_touch
BEFORE UPDATE OF instrument_tip, touch_law ON training_case
WHEN OLD.state <> 'draft' OR EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = OLD.case_id)
  OR EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = OLD.case_id)
BEGIN
  SELECT RAISE(ABORT, 'only a draft without attempts is changed: make a new version');
END;
