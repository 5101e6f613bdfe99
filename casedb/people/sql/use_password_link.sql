-- A link is used up.
DELETE FROM password_link
WHERE secret_hash = :secret_hash
RETURNING person_id
