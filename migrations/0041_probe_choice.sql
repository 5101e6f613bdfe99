-- Whether whoever attempts a case under ultrasound chooses the probe (docs/decisions/0089); of before: nobody did.
ALTER TABLE training_case ADD COLUMN probe_is_chosen INTEGER NOT NULL DEFAULT 0 CHECK (probe_is_chosen IN (0, 1));

CREATE TRIGGER training_case_keeps_its_probe BEFORE UPDATE OF probe_is_chosen ON training_case
WHEN OLD.state <> 'draft' OR EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = OLD.case_id)
  OR EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = OLD.case_id)
BEGIN
  SELECT RAISE(ABORT, 'only a draft without attempts is changed: make a new version');
END;
