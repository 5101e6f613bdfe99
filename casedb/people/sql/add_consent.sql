-- Consent stands from now on; nothing when it stands already. The row that comes back tells.
INSERT INTO consent (person_id, text_id, given_us)
VALUES (:person_id, :text_id, :given_us)
ON CONFLICT DO NOTHING
RETURNING text_id
