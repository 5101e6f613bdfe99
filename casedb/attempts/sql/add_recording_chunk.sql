-- A piece of an attempt's recording.
INSERT INTO recording_chunk (
  attempt_id, sequence, checksum, data
) VALUES (
  :attempt_id, :sequence, :checksum, :data
)
