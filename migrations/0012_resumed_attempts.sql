-- An attempt that was interrupted may be gone on with, and says for how long nobody was at it.
ALTER TABLE open_chunk ADD COLUMN stored_us INTEGER; -- when it was; null: stored before schema 12

-- By the wall's clock, all interruptions together; null: there was none, or how long it was is not known.
ALTER TABLE open_attempt ADD COLUMN away_s REAL CHECK (away_s >= 0);
ALTER TABLE attempt ADD COLUMN away_s REAL CHECK (away_s >= 0);
