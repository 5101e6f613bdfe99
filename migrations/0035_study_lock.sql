-- When a study's data were locked: what is begun afterwards is not analysed.
CREATE TABLE study_lock (
  study_id TEXT NOT NULL PRIMARY KEY REFERENCES study (study_id),
  locked_us INTEGER NOT NULL,
  actor TEXT NOT NULL CHECK (actor IN ('nobody', 'operator', 'person')),
  person_id TEXT REFERENCES person (person_id),
  data_hash TEXT NOT NULL CHECK (length(data_hash) = 64), -- SHA-256 of every value that was analysed then
  people INTEGER NOT NULL CHECK (people >= 0) -- with a value or a failure at a primary outcome
) STRICT;

CREATE TRIGGER study_lock_is_immutable BEFORE UPDATE ON study_lock
BEGIN
  SELECT RAISE(ABORT, 'a lock cannot be changed');
END;
CREATE TRIGGER study_lock_stays BEFORE DELETE ON study_lock
BEGIN
  SELECT RAISE(ABORT, 'a lock cannot be removed');
END;
