-- Somebody no longer works on a study.
UPDATE study_researcher SET to_us = max(:to_us, from_us) -- the clock may have been ahead
WHERE study_id = :study_id AND person_id = :person_id AND to_us IS NULL
RETURNING person_id
