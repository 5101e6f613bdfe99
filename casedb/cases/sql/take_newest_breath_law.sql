-- A draft again, which nobody has attempted: as deep downwards as before (migrations/0039_breath_law.sql).
UPDATE training_case SET breath_law = 'drifting_holds', breath_depth = min(3.0, breath_depth * 16.0 / 12.0)
WHERE case_id = :case_id AND breath_law = 'equal_holds'
  AND NOT EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = :case_id)
  AND NOT EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = :case_id)
