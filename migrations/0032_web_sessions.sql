-- Who is logged in at a server's pages, so that its restart logs nobody out. Of the cookie only the hash: a copy of
-- this opens nothing. A backup holds none of these rows.
CREATE TABLE web_session (
  id_hash TEXT NOT NULL PRIMARY KEY CHECK (length(id_hash) = 64), -- SHA-256; the id has only the browser
  port INTEGER NOT NULL, -- of the server that began it
  person_id TEXT NOT NULL REFERENCES person (person_id),
  password_mark TEXT NOT NULL, -- of the password, role and epoch that began it
  begun_us INTEGER NOT NULL,
  seen_us INTEGER NOT NULL CHECK (seen_us >= begun_us), -- last; written once a minute
  ends_us INTEGER NOT NULL CHECK (ends_us > begun_us)
) STRICT;
CREATE INDEX web_session_of_person ON web_session (person_id);

-- The last act that changes what people have learnt (casedb/grading/learner_records.h): log-ins lie between.
CREATE INDEX audit_of_changes ON audit (sequence)
WHERE act NOT IN ('log_in', 'log_out', 'let_in_again', 'unproven', 'not_allowed', 'comment_attempt');
