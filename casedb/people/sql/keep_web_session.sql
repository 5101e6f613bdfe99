-- A session of a server's pages begins or was used again. Nothing where its person is erased by now.
INSERT INTO web_session (id_hash, port, person_id, password_mark, begun_us, seen_us, ends_us)
SELECT :id_hash, :port, :person_id, :password_mark, :begun_us, :seen_us, :ends_us
WHERE EXISTS (SELECT 1 FROM person WHERE person.person_id = :person_id AND erased_us IS NULL)
ON CONFLICT (id_hash) DO UPDATE SET seen_us = max(seen_us, excluded.seen_us)
