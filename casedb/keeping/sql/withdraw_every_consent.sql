-- No consent of this person stands any longer.
UPDATE consent SET withdrawn_us = max(:withdrawn_us, given_us)
WHERE person_id = :person_id AND withdrawn_us IS NULL
