-- Names of people, in a file of their own: performance is read without it, and erasing a person empties one row here.

CREATE TABLE identity (
  person_id TEXT NOT NULL PRIMARY KEY CHECK (length(person_id) = 36), -- person in the library's database
  name TEXT NOT NULL CHECK (name <> ''), -- what the person types to log in
  created_us INTEGER NOT NULL
) STRICT;

-- Names compare without regard to ASCII case.
CREATE UNIQUE INDEX identity_by_name ON identity (lower(name));
