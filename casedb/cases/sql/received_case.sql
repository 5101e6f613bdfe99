-- What the sender of a case says of it, and as whom its key is trusted here now.
SELECT case_received.*, trusted_key.label AS trusted_as
FROM case_received
LEFT JOIN trusted_key ON trusted_key.public_key = case_received.signing_key
WHERE case_id = :case_id
