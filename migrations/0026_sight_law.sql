-- By which law a picture is said to show needle and target (docs/decisions/0057). Cases of before keep theirs; a new
-- version of one takes the newest.
ALTER TABLE training_case ADD COLUMN sight_law TEXT NOT NULL DEFAULT 'half_slice'
  CHECK (sight_law IN ('half_slice', 'echo'));
-- Nobody has attempted a draft that can still be changed: it takes the newest.
UPDATE training_case SET sight_law = 'echo'
WHERE state = 'draft' AND NOT EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = training_case.case_id)
  AND NOT EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = training_case.case_id);

CREATE TRIGGER training_case_keeps_its_sight_law
BEFORE UPDATE OF sight_law ON training_case
WHEN OLD.state <> 'draft' OR EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = OLD.case_id)
  OR EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = OLD.case_id)
BEGIN
  SELECT RAISE(ABORT, 'only a draft without attempts is changed: make a new version');
END;
