-- Attributes of one case, or of every one (:case_id null).
SELECT case_id, name, value FROM case_attribute
WHERE :case_id IS NULL OR case_id = :case_id
ORDER BY case_id, position
