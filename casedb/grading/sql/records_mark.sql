-- What records_of depends on. An act that changes nothing of it is passed over.
SELECT
  coalesce((SELECT sequence FROM audit
            WHERE act NOT IN ('log_in', 'log_out', 'let_in_again', 'unproven', 'not_allowed', 'comment_attempt')
            ORDER BY sequence DESC LIMIT 1), 0) AS act,
  (SELECT count(*) FROM attempt WHERE person_id = :person_id) AS attempts,
  coalesce((SELECT attempt_id FROM attempt WHERE person_id = :person_id
            ORDER BY started_us DESC, attempt_id DESC LIMIT 1), '') AS newest,
  (SELECT count(*) FROM open_attempt WHERE person_id = :person_id) AS running
