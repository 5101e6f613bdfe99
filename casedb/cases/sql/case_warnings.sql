-- Warnings of one case, or of every one (:case_id null).
SELECT case_id, code, text FROM case_warning
WHERE case_id BETWEEN coalesce(:case_id, '') AND coalesce(:case_id, '~') -- '~' is behind every id; the index serves both
ORDER BY case_id, position
