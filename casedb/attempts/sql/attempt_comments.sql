-- What was said of an attempt, moment by moment.
SELECT comment_id, at_s, body, person_id, written_us FROM attempt_comment WHERE attempt_id = :attempt_id
ORDER BY at_s, written_us
