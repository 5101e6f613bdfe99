-- Who sets a standard, and what is learnt in which order. Grades are computed when they are looked at.

-- --- standards ---
-- What somebody was, and from when on: an attempt counts by what its operator was when it began.
CREATE TABLE person_level (
  person_id TEXT NOT NULL REFERENCES person (person_id),
  since_us INTEGER NOT NULL,
  level TEXT NOT NULL CHECK (level IN ('student', 'trainee', 'consultant')),
  PRIMARY KEY (person_id, since_us)
) STRICT;

CREATE TRIGGER person_level_is_immutable BEFORE UPDATE ON person_level
BEGIN
  SELECT RAISE(ABORT, 'what somebody was cannot be changed');
END;

-- Attempts whose values may make a band. An attempt that was simulated in somebody's name is a simulated one.
CREATE VIEW expert_attempt AS
SELECT attempt_id, case_id, CASE operator_name WHEN 'person' THEN 'consultants' ELSE 'simulated' END AS kind
FROM attempt
WHERE operator_name = 'expert' OR operator_name = 'person' AND person_id IS NOT NULL AND 'consultant' = (
  SELECT level FROM person_level
  WHERE person_level.person_id = attempt.person_id AND since_us <= attempt.started_us
  ORDER BY since_us DESC LIMIT 1);

-- --- curricula ---
CREATE TABLE curriculum (
  curriculum_id TEXT NOT NULL PRIMARY KEY CHECK (length(curriculum_id) = 36),
  title TEXT NOT NULL CHECK (title <> ''),
  state TEXT NOT NULL CHECK (state IN ('draft', 'published', 'retired')),
  made_by TEXT NOT NULL REFERENCES person (person_id),
  made_us INTEGER NOT NULL,
  published_by TEXT REFERENCES person (person_id),
  published_us INTEGER,
  CHECK ((published_by IS NULL) = (published_us IS NULL) AND (state <> 'published' OR published_us IS NOT NULL))
) STRICT;

-- An item is a case in whatever version is published (docs/decisions/0022).
CREATE TABLE curriculum_item (
  curriculum_id TEXT NOT NULL REFERENCES curriculum (curriculum_id) ON DELETE CASCADE,
  position INTEGER NOT NULL CHECK (position BETWEEN 1 AND 1000),
  family_id TEXT NOT NULL CHECK (length(family_id) = 36), -- as training_case.family_id
  attempt_limit INTEGER CHECK (attempt_limit BETWEEN 1 AND 1000), -- null: the case's own
  PRIMARY KEY (curriculum_id, position),
  UNIQUE (curriculum_id, family_id)
) STRICT;

-- An item is open when each of these is reached.
CREATE TABLE curriculum_gate (
  curriculum_id TEXT NOT NULL,
  position INTEGER NOT NULL,
  after_position INTEGER NOT NULL CHECK (after_position < position),
  reached TEXT NOT NULL CHECK (reached IN ('passed', 'proficient')),
  PRIMARY KEY (curriculum_id, position, after_position),
  FOREIGN KEY (curriculum_id, position) REFERENCES curriculum_item (curriculum_id, position) ON DELETE CASCADE,
  FOREIGN KEY (curriculum_id, after_position) REFERENCES curriculum_item (curriculum_id, position) ON DELETE CASCADE
) STRICT;

CREATE TRIGGER curriculum_goes_forward BEFORE UPDATE OF state ON curriculum
WHEN (OLD.state = 'published' AND NEW.state = 'draft') OR (OLD.state = 'retired' AND NEW.state <> 'retired')
BEGIN
  SELECT RAISE(ABORT, 'a published curriculum is not changed: make another');
END;

CREATE TRIGGER curriculum_published_keeps_its_title BEFORE UPDATE OF title ON curriculum WHEN OLD.state <> 'draft'
BEGIN
  SELECT RAISE(ABORT, 'a published curriculum is not changed: make another');
END;

CREATE TRIGGER curriculum_published_is_kept BEFORE DELETE ON curriculum WHEN OLD.state <> 'draft'
BEGIN
  SELECT RAISE(ABORT, 'a published curriculum is retired, not deleted');
END;

CREATE TRIGGER curriculum_item_comes_to_a_draft BEFORE INSERT ON curriculum_item
WHEN (SELECT state FROM curriculum WHERE curriculum.curriculum_id = NEW.curriculum_id) <> 'draft'
BEGIN
  SELECT RAISE(ABORT, 'a published curriculum is not changed: make another');
END;

CREATE TRIGGER curriculum_item_is_immutable BEFORE UPDATE ON curriculum_item
BEGIN
  SELECT RAISE(ABORT, 'an item of a curriculum cannot be changed');
END;

CREATE TRIGGER curriculum_item_leaves_a_draft BEFORE DELETE ON curriculum_item
WHEN (SELECT state FROM curriculum WHERE curriculum.curriculum_id = OLD.curriculum_id) <> 'draft'
BEGIN
  SELECT RAISE(ABORT, 'a published curriculum is not changed: make another');
END;

CREATE TRIGGER curriculum_gate_comes_to_a_draft BEFORE INSERT ON curriculum_gate
WHEN (SELECT state FROM curriculum WHERE curriculum.curriculum_id = NEW.curriculum_id) <> 'draft'
BEGIN
  SELECT RAISE(ABORT, 'a published curriculum is not changed: make another');
END;

CREATE TRIGGER curriculum_gate_is_immutable BEFORE UPDATE ON curriculum_gate
BEGIN
  SELECT RAISE(ABORT, 'a gate of a curriculum cannot be changed');
END;

CREATE TRIGGER curriculum_gate_leaves_a_draft BEFORE DELETE ON curriculum_gate
WHEN (SELECT state FROM curriculum WHERE curriculum.curriculum_id = OLD.curriculum_id) <> 'draft'
BEGIN
  SELECT RAISE(ABORT, 'a published curriculum is not changed: make another');
END;
