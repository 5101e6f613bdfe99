-- What import found odd, for a new version.
INSERT INTO case_warning (case_id, position, code, text)
SELECT :case_id, position, code, text FROM case_warning
WHERE case_id = :from_case_id
