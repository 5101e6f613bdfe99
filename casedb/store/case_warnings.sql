-- Warnings of one case, or of every one (:case_id null).
SELECT case_id, code, text FROM case_warning
WHERE :case_id IS NULL OR case_id = :case_id
ORDER BY case_id, position
