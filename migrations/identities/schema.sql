-- The sum of the numbered steps beside this file: what a new library is made of. Written by casedb_database_test.

CREATE TABLE digest (
  of_table TEXT NOT NULL,
  of_id TEXT NOT NULL, -- the first column of the rows; of what an attempt has many of, the first two
  sum INTEGER NOT NULL, -- XOR of the rows' digests (casedb/database/digests.h)
  PRIMARY KEY (of_table, of_id)
) STRICT, WITHOUT ROWID;

CREATE TABLE identity (
  person_id TEXT NOT NULL PRIMARY KEY CHECK (length(person_id) = 36), -- person in the library's database
  name TEXT NOT NULL CHECK (name <> ''), -- what the person types to log in
  created_us INTEGER NOT NULL
) STRICT;

CREATE UNIQUE INDEX identity_by_name ON identity (lower(name));
