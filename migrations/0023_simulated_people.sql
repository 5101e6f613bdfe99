-- Simulated people are people of another kind, for good: whoever reads attempts, cohorts or studies meets them as such.
ALTER TABLE person ADD COLUMN kind TEXT NOT NULL DEFAULT 'real' CHECK (kind IN ('real', 'simulated'));

CREATE TRIGGER person_kind_is_immutable BEFORE UPDATE OF kind ON person WHEN NEW.kind <> OLD.kind
BEGIN
  SELECT RAISE(ABORT, 'nobody becomes simulated, or real');
END;
CREATE TRIGGER simulated_people_have_no_account BEFORE INSERT ON account
WHEN (SELECT kind FROM person WHERE person_id = NEW.person_id) = 'simulated'
BEGIN
  SELECT RAISE(ABORT, 'a simulated person has no account');
END;
CREATE TRIGGER simulated_people_make_simulated_attempts BEFORE INSERT ON attempt
WHEN NEW.operator_name = 'person' AND (SELECT kind FROM person WHERE person_id = NEW.person_id) = 'simulated'
BEGIN
  SELECT RAISE(ABORT, 'what a simulated person does is no attempt of a person');
END;

-- What was planted in them. Only the list of truths is asked of it; no question joins it to people or what they did.
CREATE TABLE simulated_truth (
  person_id TEXT NOT NULL PRIMARY KEY REFERENCES person (person_id),
  people_version INTEGER NOT NULL CHECK (people_version > 0), -- of the model (assessment/population/person.h)
  seed INTEGER NOT NULL, -- as attempt.seed
  group_name TEXT NOT NULL CHECK (group_name <> ''),
  number INTEGER NOT NULL CHECK (number > 0), -- of the person in seed and group
  eye_hand REAL NOT NULL, -- abilities before practice, in the population's standard deviations
  spatial REAL NOT NULL,
  planning REAL NOT NULL,
  conduct REAL NOT NULL,
  strategy REAL NOT NULL, -- towards fast and rough
  UNIQUE (people_version, seed, group_name, number)
) STRICT;

CREATE TRIGGER truth_is_of_simulated_people BEFORE INSERT ON simulated_truth
WHEN (SELECT kind FROM person WHERE person_id = NEW.person_id) <> 'simulated'
BEGIN
  SELECT RAISE(ABORT, 'nobody knows the ability of a real person');
END;
CREATE TRIGGER simulated_truth_is_immutable BEFORE UPDATE ON simulated_truth
BEGIN
  SELECT RAISE(ABORT, 'what was planted cannot be changed');
END;

-- Simulated people take part in studies of simulated people, and in no other. Within a text of the plan's canonical JSON
-- quotes are escaped, so only the field itself is found.
DROP VIEW consenting;
CREATE VIEW consenting AS
SELECT study.study_id, person.person_id
FROM study CROSS JOIN person
WHERE person.erased_us IS NULL AND (
  person.kind = 'simulated' AND EXISTS (SELECT 1 FROM study_plan
    WHERE study_plan.study_id = study.study_id AND instr(study_plan.body, '"people":"simulated"') > 0)
  OR EXISTS (SELECT 1 FROM consent JOIN consent_text USING (text_id)
    WHERE consent.person_id = person.person_id AND consent_text.study_id = study.study_id AND withdrawn_us IS NULL)
  OR EXISTS (SELECT 1 FROM consent JOIN consent_text USING (text_id)
    WHERE consent.person_id = person.person_id AND consent_text.study_id IS NULL AND withdrawn_us IS NULL)
  AND NOT EXISTS (SELECT 1 FROM consent JOIN consent_text USING (text_id)
    WHERE consent.person_id = person.person_id AND consent_text.study_id = study.study_id));
