-- Somebody has logged in at the command line.
INSERT INTO login_session (token_hash, person_id, password_mark, begun_us, ends_us)
VALUES (:token_hash, :person_id, :password_mark, :begun_us, :ends_us)
