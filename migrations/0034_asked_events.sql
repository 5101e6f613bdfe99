-- What a mentor who looks in on an attempt lets happen to the patient, until the program that makes the attempt has
-- taken it up. It goes when the attempt ends: what happened is in the recording.
CREATE TABLE asked_event (
  attempt_id TEXT NOT NULL REFERENCES open_attempt (attempt_id) ON DELETE CASCADE,
  position INTEGER NOT NULL CHECK (position BETWEEN 0 AND 999),
  kind TEXT NOT NULL CHECK (kind IN ('cough', 'bleeding', 'pressure_drop')),
  taken INTEGER NOT NULL DEFAULT 0 CHECK (taken IN (0, 1)),
  PRIMARY KEY (attempt_id, position)
) STRICT, WITHOUT ROWID;
