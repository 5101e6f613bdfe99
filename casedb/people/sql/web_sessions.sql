-- The sessions of a server's pages that are neither over nor from the future.
SELECT id_hash, person_id, password_mark, begun_us, seen_us, ends_us FROM web_session
WHERE port = :port AND begun_us <= :now_us AND seen_us <= :now_us AND ends_us > :now_us
ORDER BY begun_us, id_hash
