-- Whose password a link sets, while it holds.
SELECT person_id, password_mark FROM password_link
WHERE secret_hash = :secret_hash AND ends_us > :now_us
