-- A label with a known name is the tissue of its voxels (docs/decisions/0105). Maps of before count for structures
-- alone: what was practised on them stays. Nobody has attempted a draft that can still be changed.
ALTER TABLE case_label_map ADD COLUMN wins INTEGER NOT NULL DEFAULT 0 CHECK (wins IN (0, 1));
UPDATE case_label_map SET wins = 1
WHERE EXISTS (SELECT 1 FROM training_case WHERE training_case.case_id = case_label_map.case_id AND state = 'draft')
  AND NOT EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = case_label_map.case_id)
  AND NOT EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = case_label_map.case_id);
