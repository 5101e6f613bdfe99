-- A piece of an open attempt's recording.
INSERT INTO open_chunk (
  attempt_id, sequence, checksum, data, stored_us
) VALUES (
  :attempt_id, :sequence, :checksum, :data, :stored_us
)
