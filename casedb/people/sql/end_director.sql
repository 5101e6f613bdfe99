-- Somebody no longer directs a programme.
UPDATE programme_director SET to_us = max(:to_us, from_us) -- the clock may have been ahead
WHERE programme = :programme AND person_id = :person_id AND to_us IS NULL
RETURNING person_id
