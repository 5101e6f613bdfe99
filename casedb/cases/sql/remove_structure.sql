-- A structure of a draft.
DELETE FROM structure
WHERE case_id = :case_id AND title = :title
