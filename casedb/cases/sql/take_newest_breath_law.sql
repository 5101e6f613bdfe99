-- A draft again, which nobody has attempted: as deep downwards as before (migrations/0039_breath_law.sql,
-- 0046_sliding_organs.sql).
UPDATE training_case SET breath_law = 'sliding_organs',
  breath_depth = min(3.0, breath_depth * CASE breath_law WHEN 'equal_holds' THEN 16.0 / 12.0 ELSE 1.0 END)
WHERE case_id = :case_id AND breath_law <> 'sliding_organs'
  AND NOT EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = training_case.case_id)
  AND NOT EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = training_case.case_id)
