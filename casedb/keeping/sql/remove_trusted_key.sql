DELETE FROM trusted_key WHERE public_key = :key OR label = :key
