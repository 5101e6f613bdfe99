-- A replay as raters see it.
INSERT INTO rating_view (view_id, round_id, attempt_id, calibration, sheet_sha256)
VALUES (:view_id, :round_id, :attempt_id, :calibration, :sheet_sha256)
