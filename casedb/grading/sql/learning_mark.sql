-- What learning_attempts depends on. An act that changes nothing of it is passed over.
SELECT
  coalesce((SELECT sequence FROM audit
            WHERE act NOT IN ('log_in', 'log_out', 'let_in_again', 'unproven', 'not_allowed', 'comment_attempt')
            ORDER BY sequence DESC LIMIT 1), 0) AS act,
  coalesce((SELECT max(rowid) FROM attempt), 0) AS attempt
