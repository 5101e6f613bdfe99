-- A day on which people of a study go through stations: who came, in which order they go, and what is ticked where no
-- attempt tells. Which attempts were made is asked of the attempts.
CREATE TABLE workshop (
  workshop_id TEXT NOT NULL PRIMARY KEY,
  code TEXT NOT NULL CHECK (length(code) = 6), -- opens the board
  study_id TEXT NOT NULL REFERENCES study (study_id),
  title TEXT NOT NULL CHECK (title <> ''),
  seed INTEGER NOT NULL, -- of the orders in which people go
  opened_us INTEGER NOT NULL,
  opened_by TEXT REFERENCES person (person_id), -- null: the operator
  closed_us INTEGER -- null: open
) STRICT;
CREATE UNIQUE INDEX workshop_by_code ON workshop (code);

CREATE TABLE workshop_station (
  workshop_id TEXT NOT NULL REFERENCES workshop (workshop_id),
  place INTEGER NOT NULL CHECK (place >= 0),
  title TEXT NOT NULL CHECK (title <> ''),
  case_id TEXT, -- done by an attempt at it; null: it is ticked. May be gone by now
  PRIMARY KEY (workshop_id, place)
) STRICT;

CREATE TABLE workshop_group (
  workshop_id TEXT NOT NULL REFERENCES workshop (workshop_id),
  place INTEGER NOT NULL CHECK (place >= 0),
  group_name TEXT NOT NULL CHECK (group_name <> ''),
  PRIMARY KEY (workshop_id, place)
) STRICT;

CREATE TABLE workshop_participant (
  workshop_id TEXT NOT NULL REFERENCES workshop (workshop_id),
  number INTEGER NOT NULL CHECK (number > 0), -- what somebody is on the board
  person_id TEXT NOT NULL REFERENCES person (person_id),
  group_name TEXT NOT NULL, -- empty: none
  arrival INTEGER NOT NULL CHECK (arrival >= 0), -- as which of their group they came: which order is theirs
  came_us INTEGER NOT NULL,
  PRIMARY KEY (workshop_id, number)
) STRICT;
CREATE UNIQUE INDEX workshop_participant_by_person ON workshop_participant (workshop_id, person_id);
CREATE INDEX workshop_participant_of_person ON workshop_participant (person_id);

CREATE TABLE workshop_tick (
  workshop_id TEXT NOT NULL,
  number INTEGER NOT NULL,
  place INTEGER NOT NULL,
  ticked_us INTEGER NOT NULL,
  PRIMARY KEY (workshop_id, number, place),
  FOREIGN KEY (workshop_id, number) REFERENCES workshop_participant (workshop_id, number) ON DELETE CASCADE,
  FOREIGN KEY (workshop_id, place) REFERENCES workshop_station (workshop_id, place)
) STRICT;
CREATE INDEX workshop_tick_by_station ON workshop_tick (workshop_id, place);

CREATE TRIGGER workshop_participant_is_immutable BEFORE UPDATE ON workshop_participant
BEGIN
  SELECT RAISE(ABORT, 'who came is not changed');
END;
