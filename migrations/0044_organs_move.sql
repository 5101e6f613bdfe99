-- An organ that the needle presses gives way as a whole (docs/decisions/0093): one law of touch more. The column is made
-- anew, since its CHECK names the laws. Cases of before keep theirs; a new version of one takes the newest.
DROP TRIGGER training_case_keeps_its_touch;

ALTER TABLE training_case ADD COLUMN newer_touch_law TEXT NOT NULL DEFAULT 'steady'
  CHECK (newer_touch_law IN ('steady', 'by_speed', 'organs_move'));
UPDATE training_case SET newer_touch_law = touch_law;
ALTER TABLE training_case DROP COLUMN touch_law;
ALTER TABLE training_case RENAME COLUMN newer_touch_law TO touch_law;
-- Nobody has attempted a draft that can still be changed: it takes the newest.
UPDATE training_case SET touch_law = 'organs_move'
WHERE state = 'draft' AND NOT EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = training_case.case_id)
  AND NOT EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = training_case.case_id);

CREATE TRIGGER training_case_keeps_its_touch
BEFORE UPDATE OF instrument_tip, touch_law ON training_case
WHEN OLD.state <> 'draft' OR EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = OLD.case_id)
  OR EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = OLD.case_id)
BEGIN
  SELECT RAISE(ABORT, 'only a draft without attempts is changed: make a new version');
END;
