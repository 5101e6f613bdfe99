-- Ends a session of a server's pages.
DELETE FROM web_session
WHERE id_hash = :id_hash
