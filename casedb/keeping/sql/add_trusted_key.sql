INSERT INTO trusted_key (public_key, label, added_us) VALUES (:public_key, :label, :added_us)
