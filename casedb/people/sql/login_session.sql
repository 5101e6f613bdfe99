-- The session of a token that is neither over nor from the future.
SELECT person_id, password_mark FROM login_session
WHERE token_hash = :token_hash AND begun_us <= :now_us AND ends_us > :now_us
