-- A draft again, which nobody has attempted (migrations/0042_touch_by_needle.sql, 0044_organs_move.sql).
UPDATE training_case SET touch_law = 'organs_move'
WHERE case_id = :case_id AND touch_law <> 'organs_move'
  AND NOT EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = :case_id)
  AND NOT EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = :case_id)
