-- Somebody may set their password once.
INSERT INTO password_link (secret_hash, person_id, password_mark, ends_us)
VALUES (:secret_hash, :person_id, :password_mark, :ends_us)
