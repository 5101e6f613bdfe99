-- One case, or every one (:case_id null), oldest first.
SELECT * FROM training_case
WHERE case_id BETWEEN coalesce(:case_id, '') AND coalesce(:case_id, '~') -- '~' is behind every id; the index serves both
ORDER BY created_us, case_id
