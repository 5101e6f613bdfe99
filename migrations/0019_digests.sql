-- What the rows of each table hold, as one number: by it a bit that turned over on the disk is told. The program writes
-- it with every transaction; a row that was changed past the program has another.
CREATE TABLE digest (
  of_table TEXT NOT NULL,
  of_id TEXT NOT NULL, -- the first column of the rows; of what an attempt has many of, the first two
  sum INTEGER NOT NULL, -- XOR of the rows' digests (casedb/database/digests.h)
  PRIMARY KEY (of_table, of_id)
) STRICT, WITHOUT ROWID;
