-- A new password; with :old_hash, only in the place of that one.
UPDATE account SET password_hash = :password_hash
WHERE person_id = :person_id AND (:old_hash IS NULL OR password_hash = :old_hash)
