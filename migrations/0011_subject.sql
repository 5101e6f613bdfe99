-- Who or what a case is about. Cases of before have a patient.
ALTER TABLE training_case ADD COLUMN subject TEXT NOT NULL DEFAULT 'patient' CHECK (subject IN ('patient', 'phantom'));

CREATE TRIGGER training_case_keeps_its_subject BEFORE UPDATE OF subject ON training_case
WHEN OLD.state <> 'draft' OR EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = OLD.case_id)
  OR EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = OLD.case_id)
BEGIN
  SELECT RAISE(ABORT, 'only a draft without attempts is changed: make a new version');
END;
