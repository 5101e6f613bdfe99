-- Who decides at the command line, and a log of what was decided that nobody can change unseen.

-- 1: the operator entered it in that person's name; 0: the person, who had logged in; null: before this was kept.
ALTER TABLE case_decision ADD COLUMN by_operator INTEGER CHECK (by_operator IN (0, 1));
-- The same of who looked for burned-in text.
ALTER TABLE training_case ADD COLUMN burned_in_by_operator INTEGER CHECK (burned_in_by_operator IN (0, 1));
DROP TRIGGER case_decision_is_immutable;
CREATE TRIGGER case_decision_is_immutable BEFORE UPDATE ON case_decision
WHEN OLD.person_id NOT IN (SELECT id FROM erasing) OR NEW.note <> '' OR OLD.case_id <> NEW.case_id
  OR OLD.position <> NEW.position OR OLD.decision <> NEW.decision OR OLD.person_id <> NEW.person_id
  OR OLD.decided_us <> NEW.decided_us OR OLD.by_operator IS NOT NEW.by_operator
BEGIN
  SELECT RAISE(ABORT, 'a decision cannot be changed');
END;

-- One more whenever the role changes or the account is closed or opened: ends what was begun before.
ALTER TABLE account ADD COLUMN epoch INTEGER NOT NULL DEFAULT 0 CHECK (epoch >= 0);

-- Who has logged in at the command line.
CREATE TABLE login_session (
  token_hash TEXT NOT NULL PRIMARY KEY CHECK (length(token_hash) = 64), -- SHA-256; the token has only its owner
  person_id TEXT NOT NULL REFERENCES person (person_id),
  password_mark TEXT NOT NULL, -- of the password, role and epoch that began it
  begun_us INTEGER NOT NULL,
  ends_us INTEGER NOT NULL CHECK (ends_us > begun_us)
) STRICT;

-- Numbers and codes only: no name, nothing that somebody typed.
CREATE TABLE audit (
  sequence INTEGER NOT NULL PRIMARY KEY CHECK (sequence > 0),
  at_us INTEGER NOT NULL,
  actor TEXT NOT NULL CHECK (actor IN ('nobody', 'operator', 'person')),
  -- Who acted, or in whose name the operator did; null: nobody's.
  person_id TEXT REFERENCES person (person_id) CHECK (actor <> 'person' OR person_id IS NOT NULL),
  act TEXT NOT NULL CHECK (act <> '' AND act NOT GLOB '*[^a-z_]*'), -- a code of casedb/database/audit.h
  object TEXT NOT NULL CHECK (object NOT GLOB '*[^a-z_]*'), -- what kind of thing; empty: none
  object_id TEXT NOT NULL CHECK (length(object_id) <= 36 AND object_id NOT GLOB '*[^0-9a-z_-]*'),
  result TEXT NOT NULL CHECK (result IN ('done', 'refused')),
  hash TEXT NOT NULL CHECK (length(hash) = 64) -- SHA-256 of the row and of the hash before it
) STRICT;
CREATE INDEX audit_by_object ON audit (object_id, act);
-- The second place: a log whose end is cut off does not fit it.
CREATE TABLE audit_head (
  id INTEGER NOT NULL PRIMARY KEY CHECK (id = 1),
  count INTEGER NOT NULL CHECK (count >= 0),
  hash TEXT NOT NULL CHECK (length(hash) = 64)
) STRICT;
INSERT INTO audit_head VALUES (1, 0, '0000000000000000000000000000000000000000000000000000000000000000');

CREATE TRIGGER audit_goes_on BEFORE INSERT ON audit
WHEN NEW.sequence <> (SELECT count + 1 FROM audit_head)
BEGIN
  SELECT RAISE(ABORT, 'the audit log is only written at its end');
END;
CREATE TRIGGER audit_is_immutable BEFORE UPDATE ON audit
BEGIN
  SELECT RAISE(ABORT, 'the audit log cannot be changed');
END;
CREATE TRIGGER audit_is_kept BEFORE DELETE ON audit
BEGIN
  SELECT RAISE(ABORT, 'the audit log cannot be deleted');
END;
CREATE TRIGGER audit_head_goes_on BEFORE UPDATE ON audit_head
WHEN NEW.id <> 1 OR NEW.count <> OLD.count + 1
BEGIN
  SELECT RAISE(ABORT, 'the audit log only grows');
END;
CREATE TRIGGER audit_head_is_kept BEFORE DELETE ON audit_head
BEGIN
  SELECT RAISE(ABORT, 'the audit log cannot be deleted');
END;
