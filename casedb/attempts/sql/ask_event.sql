-- A mentor lets something happen in an attempt that is being made.
INSERT INTO asked_event (attempt_id, position, kind)
VALUES (:attempt_id, (SELECT count(*) FROM asked_event WHERE attempt_id = :attempt_id), :kind)
