-- A cut for a case's item, by a method, with the data that it came from. Somebody proposes it, a second person
-- freezes it; from then on it stands. Whoever is in the data is s1, s2, … and j1, j2, …: nobody is named.
CREATE TABLE cut (
  cut_id TEXT NOT NULL PRIMARY KEY CHECK (length(cut_id) = 36),
  case_id TEXT NOT NULL REFERENCES training_case (case_id),
  metric_id TEXT CHECK (metric_id <> ''), -- null: of a share of items, as judges of Angoff's method have it
  version INTEGER CHECK (version > 0), -- of the metric
  higher_is_better INTEGER NOT NULL CHECK (higher_is_better IN (0, 1)),
  method TEXT NOT NULL CHECK (method IN ('contrasting_groups', 'borderline', 'angoff', 'hofstee')),
  options TEXT NOT NULL, -- of the method: k=v,k=v
  data TEXT NOT NULL CHECK (data <> ''), -- CSV, columns value, group, subject, rater, x as far as given
  value REAL NOT NULL,
  low REAL, -- both null: there is no interval
  high REAL CHECK (high >= low),
  n INTEGER NOT NULL CHECK (n > 0), -- persons or judges that it rests on
  words TEXT NOT NULL CHECK (words <> ''), -- the method in words, with what was chosen
  proposed_by TEXT NOT NULL REFERENCES person (person_id),
  proposed_us INTEGER NOT NULL,
  frozen_by TEXT REFERENCES person (person_id),
  frozen_us INTEGER,
  CHECK ((metric_id IS NULL) = (version IS NULL)),
  CHECK ((low IS NULL) = (high IS NULL)),
  CHECK ((frozen_by IS NULL) = (frozen_us IS NULL)),
  CHECK (frozen_by IS NULL OR frozen_by <> proposed_by)
) STRICT;
CREATE INDEX cut_by_case ON cut (case_id);

CREATE TRIGGER cut_is_immutable BEFORE UPDATE ON cut
WHEN OLD.frozen_us IS NOT NULL OR NEW.frozen_us IS NULL OR NEW.cut_id <> OLD.cut_id OR NEW.case_id <> OLD.case_id
  OR NEW.metric_id IS NOT OLD.metric_id OR NEW.version IS NOT OLD.version
  OR NEW.higher_is_better <> OLD.higher_is_better OR NEW.method <> OLD.method OR NEW.options <> OLD.options
  OR NEW.data <> OLD.data OR NEW.value <> OLD.value OR NEW.low IS NOT OLD.low OR NEW.high IS NOT OLD.high
  OR NEW.n <> OLD.n OR NEW.words <> OLD.words OR NEW.proposed_by <> OLD.proposed_by
  OR NEW.proposed_us <> OLD.proposed_us
BEGIN
  SELECT RAISE(ABORT, 'a cut is not changed: propose another');
END;
CREATE TRIGGER cut_is_kept BEFORE DELETE ON cut
WHEN OLD.case_id NOT IN (SELECT id FROM erasing)
  AND EXISTS (SELECT 1 FROM training_case WHERE training_case.case_id = OLD.case_id)
BEGIN
  SELECT RAISE(ABORT, 'a cut cannot be deleted');
END;
