-- What came in a bundle: what its sender says of the case. None of it is this library's word: here the case is to be
-- reviewed, and its pictures to be looked through, as any other.
CREATE TABLE case_received (
  case_id TEXT NOT NULL PRIMARY KEY REFERENCES training_case (case_id) ON DELETE CASCADE,
  received_us INTEGER NOT NULL,
  state TEXT NOT NULL CHECK (state IN ('draft', 'review', 'published', 'retired')),
  face_state TEXT NOT NULL CHECK (face_state IN ('unchecked', 'none', 'cropped', 'defaced')),
  burned_in_checked_us INTEGER, -- null: the sender does not say that anybody looked
  signing_key TEXT CHECK (length(signing_key) = 64) -- the public key, in hexadecimal; null: unsigned
) STRICT;

CREATE TRIGGER case_received_is_immutable BEFORE UPDATE ON case_received
BEGIN
  SELECT RAISE(ABORT, 'what a sender said cannot be changed');
END;

-- Whose signatures under a bundle are known here.
CREATE TABLE trusted_key (
  public_key TEXT NOT NULL PRIMARY KEY CHECK (length(public_key) = 64),
  label TEXT NOT NULL UNIQUE CHECK (label <> ''),
  added_us INTEGER NOT NULL
) STRICT;
