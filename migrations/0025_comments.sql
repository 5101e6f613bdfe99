-- What mentors say of an attempt, each at a moment of it; gone with the attempt, and with who wrote it.
CREATE TABLE attempt_comment (
  attempt_id TEXT NOT NULL REFERENCES attempt (attempt_id),
  comment_id TEXT NOT NULL,
  at_s REAL NOT NULL CHECK (at_s >= 0), -- since the attempt began
  body TEXT NOT NULL CHECK (body <> ''),
  person_id TEXT REFERENCES person (person_id), -- null: the operator
  written_us INTEGER NOT NULL,
  PRIMARY KEY (attempt_id, comment_id)
) STRICT;
CREATE INDEX attempt_comment_by_person ON attempt_comment (person_id);

CREATE TRIGGER attempt_comment_is_immutable BEFORE UPDATE ON attempt_comment
BEGIN
  SELECT RAISE(ABORT, 'a comment is not changed');
END;
