-- Whether a case is fit to be shown: its face, burned-in text, and what of the source stayed outside.

-- Cases of before were not looked at.
ALTER TABLE training_case ADD COLUMN face_state TEXT NOT NULL DEFAULT 'unchecked'
  CHECK (face_state IN ('unchecked', 'none', 'cropped', 'defaced'));

-- When somebody looked through the slices and saw no text, and who; null: nobody did. Without a person: at the command
-- line, or the person was erased since.
ALTER TABLE training_case ADD COLUMN burned_in_checked_us INTEGER;
ALTER TABLE training_case ADD COLUMN burned_in_checked_by TEXT REFERENCES person (person_id) ON DELETE SET NULL
  CHECK (burned_in_checked_by IS NULL OR burned_in_checked_us IS NOT NULL);

CREATE TRIGGER training_case_keeps_its_face_state BEFORE UPDATE OF face_state ON training_case
BEGIN
  SELECT RAISE(ABORT, 'the face state of a case cannot be changed');
END;

CREATE TRIGGER training_case_keeps_its_burned_in_check BEFORE UPDATE OF burned_in_checked_us ON training_case
WHEN OLD.burned_in_checked_us IS NOT NULL
BEGIN
  SELECT RAISE(ABORT, 'a confirmation cannot be changed');
END;

-- How many elements of the source did not enter, by tag and reason. Never a value.
CREATE TABLE case_dropped (
  case_id TEXT NOT NULL REFERENCES training_case (case_id) ON DELETE CASCADE,
  position INTEGER NOT NULL CHECK (position >= 0),
  tag TEXT NOT NULL,
  keyword TEXT NOT NULL, -- of the de-identification table; empty where it has none
  reason TEXT NOT NULL CHECK (reason IN ('not_on_the_list', 'private', 'value_not_accepted')),
  count INTEGER NOT NULL CHECK (count > 0),
  PRIMARY KEY (case_id, position)
) STRICT;
