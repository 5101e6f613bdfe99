-- With it somebody sets their own password, once. Of the link only the hash: a copy of this opens nothing. A restored
-- library holds none of these rows.
CREATE TABLE password_link (
  secret_hash TEXT NOT NULL PRIMARY KEY CHECK (length(secret_hash) = 64), -- SHA-256; the link has only who was given it
  person_id TEXT NOT NULL REFERENCES person (person_id),
  password_mark TEXT NOT NULL, -- of the password, role and epoch at which it was made
  ends_us INTEGER NOT NULL
) STRICT;
CREATE INDEX password_link_of_person ON password_link (person_id);

-- The last act that changes how far everybody is (casedb/grading/learner_records.h).
CREATE INDEX audit_of_everybodys_records ON audit (sequence)
WHERE act IN ('publish_case', 'retire_case', 'publish_curriculum', 'retire_curriculum', 'import_cases', 'erase_case',
              'recompute', 'repair', 'accept_damaged', 'restore');
