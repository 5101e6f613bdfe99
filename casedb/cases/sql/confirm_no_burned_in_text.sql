-- Somebody looked through a case's slices, and saw no text.
UPDATE training_case SET burned_in_checked_us = :checked_us, burned_in_checked_by = :person_id,
  burned_in_by_operator = :by_operator
WHERE case_id = :case_id AND burned_in_checked_us IS NULL
