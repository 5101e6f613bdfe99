-- Every case, oldest first.
SELECT case_id FROM training_case
ORDER BY created_us, case_id
