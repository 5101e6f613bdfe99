-- Ends the session of a token.
DELETE FROM login_session
WHERE token_hash = :token_hash
RETURNING person_id
