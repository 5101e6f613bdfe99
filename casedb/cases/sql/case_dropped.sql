-- What of the sources of one case, or of every one (:case_id null), did not enter.
SELECT case_id, tag, keyword, reason, count FROM case_dropped
WHERE :case_id IS NULL OR case_id = :case_id
ORDER BY case_id, position
