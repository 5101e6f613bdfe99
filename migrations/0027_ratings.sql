-- Replays rated by raters who are not told whose they are. A rating is a set of answers to the round's form; what
-- stands here is which replay it is about. Raters have no names: a key of their own opens their bench.
CREATE TABLE rating_round (
  round_id TEXT NOT NULL PRIMARY KEY REFERENCES questionnaire_round (round_id),
  each INTEGER NOT NULL CHECK (each > 0), -- as many raters rate a replay
  seed TEXT NOT NULL CHECK (length(seed) = 16) -- of who rates what in which order; whoever rates is not told
) STRICT;

CREATE TABLE rating_rater (
  round_id TEXT NOT NULL REFERENCES rating_round (round_id),
  rater TEXT NOT NULL CHECK (rater <> ''), -- "R1"
  key_hash TEXT NOT NULL CHECK (length(key_hash) = 64), -- SHA-256 of what opens the bench
  PRIMARY KEY (round_id, rater)
) STRICT;
CREATE UNIQUE INDEX rating_rater_by_key ON rating_rater (key_hash);

-- A replay as raters see it, drawn when the round was opened.
CREATE TABLE rating_view (
  view_id TEXT NOT NULL PRIMARY KEY,
  round_id TEXT NOT NULL REFERENCES rating_round (round_id),
  attempt_id TEXT NOT NULL REFERENCES attempt (attempt_id),
  calibration INTEGER NOT NULL CHECK (calibration IN (0, 1)),
  sheet_sha256 TEXT NOT NULL CHECK (length(sheet_sha256) = 64)
) STRICT;
CREATE INDEX rating_view_by_attempt ON rating_view (attempt_id);
CREATE INDEX rating_view_by_round ON rating_view (round_id);

-- What experts agreed on for a replay of the calibration set.
CREATE TABLE rating_known (
  view_id TEXT NOT NULL REFERENCES rating_view (view_id) DEFERRABLE INITIALLY DEFERRED,
  item_id TEXT NOT NULL CHECK (item_id <> ''),
  value REAL NOT NULL,
  PRIMARY KEY (view_id, item_id)
) STRICT;

CREATE TABLE rating (
  response_id TEXT NOT NULL PRIMARY KEY REFERENCES response_set (response_id) DEFERRABLE INITIALLY DEFERRED,
  round_id TEXT NOT NULL,
  rater TEXT NOT NULL,
  number INTEGER NOT NULL CHECK (number > 0), -- in this rater's order, and all that they see of which replay it is
  view_id TEXT NOT NULL REFERENCES rating_view (view_id) DEFERRABLE INITIALLY DEFERRED,
  part TEXT NOT NULL CHECK (part IN ('calibration', 'rated', 'repeated')),
  FOREIGN KEY (round_id, rater) REFERENCES rating_rater (round_id, rater)
) STRICT;
CREATE UNIQUE INDEX rating_by_number ON rating (round_id, rater, number);
CREATE INDEX rating_by_view ON rating (view_id);

CREATE TRIGGER rating_is_immutable BEFORE UPDATE ON rating
BEGIN
  SELECT RAISE(ABORT, 'who rates what is not changed');
END;
CREATE TRIGGER rating_view_is_immutable BEFORE UPDATE ON rating_view
BEGIN
  SELECT RAISE(ABORT, 'what raters see is not changed');
END;
CREATE TRIGGER rating_known_is_immutable BEFORE UPDATE ON rating_known
BEGIN
  SELECT RAISE(ABORT, 'a known score is not changed');
END;
-- With an attempt goes what raters saw of it and what they said of it.
CREATE TRIGGER rating_view_is_kept BEFORE DELETE ON rating_view
WHEN OLD.attempt_id NOT IN (SELECT id FROM erasing)
BEGIN
  SELECT RAISE(ABORT, 'a rated replay cannot be deleted');
END;
CREATE TRIGGER rating_view_goes_with_its_ratings BEFORE DELETE ON rating_view
WHEN OLD.attempt_id IN (SELECT id FROM erasing)
BEGIN
  DELETE FROM response WHERE response_id IN (SELECT response_id FROM rating WHERE view_id = OLD.view_id);
  DELETE FROM response_set WHERE response_id IN (SELECT response_id FROM rating WHERE view_id = OLD.view_id);
  DELETE FROM rating WHERE view_id = OLD.view_id;
  DELETE FROM rating_known WHERE view_id = OLD.view_id;
END;
