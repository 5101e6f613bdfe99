-- What import kept, for a new version.
INSERT INTO case_attribute (case_id, position, name, value)
SELECT :case_id, position, name, value FROM case_attribute
WHERE case_id = :from_case_id
