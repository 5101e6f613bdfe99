-- The plan of a study: a draft until it is frozen, then as it is for good.
CREATE TABLE study_plan (
  study_id TEXT NOT NULL PRIMARY KEY REFERENCES study (study_id),
  body TEXT NOT NULL CHECK (body <> ''), -- canonical JSON (assessment/study/plan.h)
  body_hash TEXT NOT NULL CHECK (length(body_hash) = 64), -- SHA-256 of body
  stored_us INTEGER NOT NULL,
  frozen_us INTEGER, -- null: a draft
  frozen_by TEXT REFERENCES person (person_id), -- null: the operator
  seed TEXT CHECK (length(seed) = 64), -- of the allocation, drawn when the plan is frozen; never shown while it runs
  seed_hash TEXT CHECK (length(seed_hash) = 64) -- SHA-256 of seed: shown, so that nobody can choose another later
) STRICT;

CREATE TRIGGER frozen_plan_is_immutable BEFORE UPDATE ON study_plan WHEN OLD.frozen_us IS NOT NULL
BEGIN
  SELECT RAISE(ABORT, 'a frozen plan cannot be changed');
END;
CREATE TRIGGER frozen_plan_stays BEFORE DELETE ON study_plan WHEN OLD.frozen_us IS NOT NULL
BEGIN
  SELECT RAISE(ABORT, 'a frozen plan cannot be removed');
END;

-- How many places of each stratum's sequence are taken, whoever has left since.
CREATE TABLE study_stratum (
  study_id TEXT NOT NULL REFERENCES study (study_id),
  stratum TEXT NOT NULL, -- "handedness=right"; empty: there is one
  taken INTEGER NOT NULL CHECK (taken > 0),
  PRIMARY KEY (study_id, stratum)
) STRICT;

-- Who takes part, and in which group since then.
CREATE TABLE study_enrolment (
  study_id TEXT NOT NULL REFERENCES study (study_id),
  person_id TEXT NOT NULL REFERENCES person (person_id),
  enrolled_us INTEGER NOT NULL,
  group_name TEXT NOT NULL CHECK (group_name <> ''),
  stratum TEXT NOT NULL,
  position INTEGER NOT NULL CHECK (position >= 0), -- in the stratum's sequence
  PRIMARY KEY (study_id, person_id)
) STRICT;
CREATE INDEX study_enrolment_by_person ON study_enrolment (person_id);
CREATE UNIQUE INDEX study_enrolment_place ON study_enrolment (study_id, stratum, position);

CREATE TRIGGER study_enrolment_is_immutable BEFORE UPDATE ON study_enrolment
BEGIN
  SELECT RAISE(ABORT, 'an allocation cannot be changed');
END;

-- Who saw outcomes by group, when, and by what.
CREATE TABLE study_look (
  study_id TEXT NOT NULL REFERENCES study (study_id),
  number INTEGER NOT NULL CHECK (number > 0),
  at_us INTEGER NOT NULL,
  actor TEXT NOT NULL CHECK (actor IN ('nobody', 'operator', 'person')),
  person_id TEXT REFERENCES person (person_id),
  query TEXT NOT NULL CHECK (query <> ''),
  people INTEGER NOT NULL CHECK (people >= 0), -- with a value or a failure at a primary outcome by then
  PRIMARY KEY (study_id, number)
) STRICT;

CREATE TRIGGER study_look_is_immutable BEFORE UPDATE ON study_look
BEGIN
  SELECT RAISE(ABORT, 'a look cannot be changed');
END;
CREATE TRIGGER study_look_stays BEFORE DELETE ON study_look
BEGIN
  SELECT RAISE(ABORT, 'a look cannot be removed');
END;

-- What was done otherwise than planned.
CREATE TABLE study_deviation (
  study_id TEXT NOT NULL REFERENCES study (study_id),
  number INTEGER NOT NULL CHECK (number > 0),
  at_us INTEGER NOT NULL,
  actor TEXT NOT NULL CHECK (actor IN ('nobody', 'operator', 'person')),
  person_id TEXT REFERENCES person (person_id),
  body TEXT NOT NULL CHECK (body <> ''),
  PRIMARY KEY (study_id, number)
) STRICT;

CREATE TRIGGER study_deviation_is_immutable BEFORE UPDATE ON study_deviation
BEGIN
  SELECT RAISE(ABORT, 'a deviation cannot be changed');
END;
CREATE TRIGGER study_deviation_stays BEFORE DELETE ON study_deviation
BEGIN
  SELECT RAISE(ABORT, 'a deviation cannot be removed');
END;
