-- Somebody says something of a moment of an attempt.
INSERT INTO attempt_comment (attempt_id, comment_id, at_s, body, person_id, written_us)
VALUES (:attempt_id, :comment_id, :at_s, :body, :person_id, :now_us)
