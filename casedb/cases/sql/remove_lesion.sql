-- A target of a draft.
DELETE FROM lesion
WHERE case_id = :case_id AND lesion_id = :lesion_id
