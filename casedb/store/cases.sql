-- One case, or every one (:case_id null), oldest first.
SELECT * FROM training_case
WHERE :case_id IS NULL OR case_id = :case_id
ORDER BY created_us, case_id
