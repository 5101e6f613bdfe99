-- The earlier links of a person, and everybody's that are over.
DELETE FROM password_link
WHERE person_id = :person_id OR ends_us <= :now_us
