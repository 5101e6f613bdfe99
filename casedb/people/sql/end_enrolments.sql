-- Somebody leaves a cohort, in whatever post.
UPDATE enrolment SET to_us = max(:to_us, from_us) -- the clock may have been ahead
WHERE cohort_id = :cohort_id AND person_id = :person_id AND to_us IS NULL
RETURNING cohort_id
