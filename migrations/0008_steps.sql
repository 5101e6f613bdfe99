-- What an attempt's recording says of each step of the procedure (assessment/procedure/steps.h).
CREATE TABLE attempt_step (
  attempt_id TEXT NOT NULL REFERENCES attempt (attempt_id),
  step_id TEXT NOT NULL,
  version INTEGER NOT NULL CHECK (version > 0),
  position INTEGER NOT NULL CHECK (position >= 0), -- the order in which they are to be done
  state TEXT NOT NULL CHECK (state IN ('done', 'skipped', 'violated', 'not_asked')),
  t_s REAL, -- when it was done, too late or violated; null: never
  reason TEXT NOT NULL, -- why it was not asked for; else empty
  PRIMARY KEY (attempt_id, step_id, version),
  CHECK ((state = 'not_asked') = (reason <> ''))
) STRICT, WITHOUT ROWID;

CREATE TRIGGER attempt_step_is_immutable BEFORE UPDATE ON attempt_step
BEGIN
  SELECT RAISE(ABORT, 'a step of an attempt cannot be changed');
END;

CREATE TRIGGER attempt_step_is_kept BEFORE DELETE ON attempt_step
BEGIN
  SELECT RAISE(ABORT, 'a step of an attempt cannot be deleted');
END;
