-- Under which conditions an attempt was made, and which replays somebody watched.

-- One row a condition that is known (casedb/attempts/condition_table.h); what has no row is not known. Attempts from
-- before schema 13 have none.
CREATE TABLE attempt_condition (
  attempt_id TEXT NOT NULL REFERENCES attempt (attempt_id),
  condition_id TEXT NOT NULL,
  number REAL,
  words TEXT,
  PRIMARY KEY (attempt_id, condition_id),
  CHECK ((number IS NULL) <> (words IS NULL))
) STRICT, WITHOUT ROWID;

CREATE TRIGGER attempt_condition_is_immutable BEFORE UPDATE ON attempt_condition
BEGIN
  SELECT RAISE(ABORT, 'a condition of an attempt cannot be changed');
END;

CREATE TRIGGER attempt_condition_is_kept BEFORE DELETE ON attempt_condition
BEGIN
  SELECT RAISE(ABORT, 'a condition of an attempt cannot be deleted');
END;

-- The same of an attempt that runs, as far as it is known by now.
CREATE TABLE open_attempt_condition (
  attempt_id TEXT NOT NULL REFERENCES open_attempt (attempt_id) ON DELETE CASCADE,
  condition_id TEXT NOT NULL,
  number REAL,
  words TEXT,
  PRIMARY KEY (attempt_id, condition_id),
  CHECK ((number IS NULL) <> (words IS NULL))
) STRICT, WITHOUT ROWID;

-- A stored attempt that somebody has watched.
CREATE TABLE replay_watched (
  person_id TEXT NOT NULL REFERENCES person (person_id),
  attempt_id TEXT NOT NULL REFERENCES attempt (attempt_id),
  watched_us INTEGER NOT NULL,
  PRIMARY KEY (person_id, attempt_id, watched_us)
) STRICT, WITHOUT ROWID;
