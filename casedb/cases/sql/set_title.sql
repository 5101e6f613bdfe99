-- The name of a case that is not published.
UPDATE training_case SET title = :title
WHERE case_id = :case_id
