-- A draft goes on under another secret.
UPDATE response_set SET draft_key = :draft_key WHERE response_id = :response_id
