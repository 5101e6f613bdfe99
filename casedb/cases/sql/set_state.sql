-- Where a version stands.
UPDATE training_case SET audience = :audience, state = :state
WHERE case_id = :case_id
