-- The next version of a text, of a study or of the library.
INSERT INTO consent_text (text_id, study_id, version, body, body_hash, created_us)
SELECT :text_id, :study_id, coalesce(max(version), 0) + 1, :body, :body_hash, :created_us
FROM consent_text WHERE study_id IS :study_id
RETURNING version
