-- People beside their accounts: cohorts and who belongs to them, facts that people give of themselves, studies and
-- consent, and erasure. No name of anybody stands here.

ALTER TABLE person ADD COLUMN erased_us INTEGER; -- since then an empty row: only what others decided refers to it

CREATE TABLE cohort (
  cohort_id TEXT NOT NULL PRIMARY KEY CHECK (length(cohort_id) = 36),
  title TEXT NOT NULL UNIQUE CHECK (title <> ''),
  programme TEXT NOT NULL CHECK (programme <> ''),
  site TEXT NOT NULL, -- empty: not said
  created_us INTEGER NOT NULL
) STRICT;

CREATE TABLE enrolment (
  cohort_id TEXT NOT NULL REFERENCES cohort (cohort_id),
  person_id TEXT NOT NULL REFERENCES person (person_id),
  post TEXT NOT NULL CHECK (post IN ('learner', 'mentor')),
  from_us INTEGER NOT NULL,
  to_us INTEGER CHECK (to_us >= from_us), -- null: still
  PRIMARY KEY (cohort_id, person_id, post, from_us)
) STRICT;
CREATE INDEX enrolment_by_person ON enrolment (person_id);

CREATE TABLE programme_director (
  programme TEXT NOT NULL CHECK (programme <> ''), -- as cohort.programme
  person_id TEXT NOT NULL REFERENCES person (person_id),
  from_us INTEGER NOT NULL,
  to_us INTEGER CHECK (to_us >= from_us),
  PRIMARY KEY (programme, person_id, from_us)
) STRICT;

-- Whom a case reaches that was published to a mentor's own cohort: the cohorts this mentor led then.
CREATE TABLE case_cohort (
  case_id TEXT NOT NULL REFERENCES training_case (case_id) ON DELETE CASCADE,
  cohort_id TEXT NOT NULL REFERENCES cohort (cohort_id),
  PRIMARY KEY (case_id, cohort_id)
) STRICT;

-- What people say of themselves; the facts that are known are rows of casedb/people/facts.cpp. A later answer does
-- not replace an earlier one: an attempt has the answer that held when it was made.
CREATE TABLE person_fact (
  person_id TEXT NOT NULL REFERENCES person (person_id),
  fact_id TEXT NOT NULL,
  given_us INTEGER NOT NULL,
  answer TEXT NOT NULL CHECK (answer <> ''),
  PRIMARY KEY (person_id, fact_id, given_us)
) STRICT;

CREATE TABLE study (
  study_id TEXT NOT NULL PRIMARY KEY CHECK (length(study_id) = 36),
  title TEXT NOT NULL UNIQUE CHECK (title <> ''),
  created_us INTEGER NOT NULL
) STRICT;

CREATE TABLE study_researcher (
  study_id TEXT NOT NULL REFERENCES study (study_id),
  person_id TEXT NOT NULL REFERENCES person (person_id),
  from_us INTEGER NOT NULL,
  to_us INTEGER CHECK (to_us >= from_us),
  PRIMARY KEY (study_id, person_id, from_us)
) STRICT;

-- What people are asked to consent to.
CREATE TABLE consent_text (
  text_id TEXT NOT NULL PRIMARY KEY CHECK (length(text_id) = 36),
  study_id TEXT REFERENCES study (study_id), -- null: research with this library, whatever the study
  version INTEGER NOT NULL CHECK (version > 0),
  body TEXT NOT NULL CHECK (body <> ''),
  body_hash TEXT NOT NULL CHECK (length(body_hash) = 64), -- SHA-256 of body
  created_us INTEGER NOT NULL
) STRICT;
CREATE UNIQUE INDEX consent_text_version ON consent_text (coalesce(study_id, ''), version);

CREATE TABLE consent (
  person_id TEXT NOT NULL REFERENCES person (person_id),
  text_id TEXT NOT NULL REFERENCES consent_text (text_id),
  given_us INTEGER NOT NULL,
  withdrawn_us INTEGER CHECK (withdrawn_us >= given_us), -- null: it stands
  PRIMARY KEY (person_id, text_id, given_us)
) STRICT;
CREATE UNIQUE INDEX consent_stands_once ON consent (person_id, text_id) WHERE withdrawn_us IS NULL;

CREATE TRIGGER consent_text_is_immutable BEFORE UPDATE ON consent_text
BEGIN
  SELECT RAISE(ABORT, 'a consent text cannot be changed: make a new version');
END;
CREATE TRIGGER consent_text_is_kept BEFORE DELETE ON consent_text
BEGIN
  SELECT RAISE(ABORT, 'a consent text cannot be deleted');
END;
CREATE TRIGGER consent_is_only_withdrawn BEFORE UPDATE ON consent
WHEN OLD.withdrawn_us IS NOT NULL OR NEW.withdrawn_us IS NULL OR OLD.person_id <> NEW.person_id
  OR OLD.text_id <> NEW.text_id OR OLD.given_us <> NEW.given_us
BEGIN
  SELECT RAISE(ABORT, 'a consent is withdrawn once and not changed otherwise');
END;
CREATE TRIGGER consent_is_kept BEFORE DELETE ON consent
BEGIN
  SELECT RAISE(ABORT, 'a consent cannot be deleted');
END;
CREATE TRIGGER person_fact_is_immutable BEFORE UPDATE ON person_fact
BEGIN
  SELECT RAISE(ABORT, 'an answer cannot be changed: give another');
END;

-- What was erased, when, and by whom: nothing of what it was.
CREATE TABLE erasure (
  erasure_id TEXT NOT NULL PRIMARY KEY CHECK (length(erasure_id) = 36),
  what TEXT NOT NULL CHECK (what IN ('person', 'attempts', 'case')), -- attempts: of a person who stays, or one
  erased_us INTEGER NOT NULL,
  by_person_id TEXT REFERENCES person (person_id) -- null: whoever has the library's files
) STRICT;

-- An empty row in the place of each attempt that was erased, so that studies can tell how many are missing.
CREATE TABLE erased_attempt (
  erasure_id TEXT NOT NULL REFERENCES erasure (erasure_id),
  position INTEGER NOT NULL CHECK (position >= 0),
  case_id TEXT NOT NULL, -- may be gone by now
  PRIMARY KEY (erasure_id, position)
) STRICT;

CREATE TRIGGER erasure_is_immutable BEFORE UPDATE ON erasure
BEGIN
  SELECT RAISE(ABORT, 'an erasure cannot be changed');
END;
CREATE TRIGGER erasure_is_kept BEFORE DELETE ON erasure
BEGIN
  SELECT RAISE(ABORT, 'an erasure cannot be taken back');
END;
CREATE TRIGGER erased_attempt_is_immutable BEFORE UPDATE ON erased_attempt
BEGIN
  SELECT RAISE(ABORT, 'an erasure cannot be changed');
END;
CREATE TRIGGER erased_attempt_is_kept BEFORE DELETE ON erased_attempt
BEGIN
  SELECT RAISE(ABORT, 'an erasure cannot be taken back');
END;

-- What is being erased, within one transaction: empty outside. Only what stands here may go.
CREATE TABLE erasing (
  id TEXT NOT NULL PRIMARY KEY -- of an attempt, a case or a person
) STRICT;

DROP TRIGGER attempt_is_kept;
CREATE TRIGGER attempt_is_kept BEFORE DELETE ON attempt
WHEN OLD.attempt_id NOT IN (SELECT id FROM erasing)
BEGIN
  SELECT RAISE(ABORT, 'an attempt cannot be deleted');
END;
DROP TRIGGER attempt_step_is_kept;
CREATE TRIGGER attempt_step_is_kept BEFORE DELETE ON attempt_step
WHEN OLD.attempt_id NOT IN (SELECT id FROM erasing)
BEGIN
  SELECT RAISE(ABORT, 'a step of an attempt cannot be deleted');
END;
DROP TRIGGER metric_value_is_kept;
CREATE TRIGGER metric_value_is_kept BEFORE DELETE ON metric_value
WHEN OLD.attempt_id NOT IN (SELECT id FROM erasing)
BEGIN
  SELECT RAISE(ABORT, 'a score cannot be deleted');
END;
DROP TRIGGER recording_chunk_is_kept;
CREATE TRIGGER recording_chunk_is_kept BEFORE DELETE ON recording_chunk
WHEN OLD.attempt_id NOT IN (SELECT id FROM erasing)
BEGIN
  SELECT RAISE(ABORT, 'a recording cannot be deleted');
END;
DROP TRIGGER servo_record_is_kept;
CREATE TRIGGER servo_record_is_kept BEFORE DELETE ON servo_record
WHEN OLD.attempt_id NOT IN (SELECT id FROM erasing)
BEGIN
  SELECT RAISE(ABORT, 'a servo record cannot be deleted');
END;
DROP TRIGGER attempt_condition_is_kept;
CREATE TRIGGER attempt_condition_is_kept BEFORE DELETE ON attempt_condition
WHEN OLD.attempt_id NOT IN (SELECT id FROM erasing)
BEGIN
  SELECT RAISE(ABORT, 'a condition of an attempt cannot be deleted');
END;
DROP TRIGGER standard_is_kept;
CREATE TRIGGER standard_is_kept BEFORE DELETE ON standard
WHEN OLD.case_id NOT IN (SELECT id FROM erasing)
  AND EXISTS (SELECT 1 FROM training_case WHERE training_case.case_id = OLD.case_id)
BEGIN
  SELECT RAISE(ABORT, 'a standard cannot be deleted');
END;
DROP TRIGGER standard_band_is_kept;
CREATE TRIGGER standard_band_is_kept BEFORE DELETE ON standard_band
WHEN EXISTS (SELECT 1 FROM standard
  WHERE standard.standard_id = OLD.standard_id AND standard.case_id NOT IN (SELECT id FROM erasing))
BEGIN
  SELECT RAISE(ABORT, 'a standard cannot be changed: set another');
END;
DROP TRIGGER case_decision_is_kept;
CREATE TRIGGER case_decision_is_kept BEFORE DELETE ON case_decision
WHEN OLD.case_id NOT IN (SELECT id FROM erasing)
BEGIN
  SELECT RAISE(ABORT, 'a decision cannot be deleted');
END;
-- The decision of an erased person stays, what this person wrote about it does not.
DROP TRIGGER case_decision_is_immutable;
CREATE TRIGGER case_decision_is_immutable BEFORE UPDATE ON case_decision
WHEN OLD.person_id NOT IN (SELECT id FROM erasing) OR NEW.note <> '' OR OLD.case_id <> NEW.case_id
  OR OLD.position <> NEW.position OR OLD.decision <> NEW.decision OR OLD.person_id <> NEW.person_id
  OR OLD.decided_us <> NEW.decided_us
BEGIN
  SELECT RAISE(ABORT, 'a decision cannot be changed');
END;
DROP TRIGGER lesion_leaves_a_draft;
CREATE TRIGGER lesion_leaves_a_draft BEFORE DELETE ON lesion
WHEN (SELECT state FROM training_case WHERE training_case.case_id = OLD.case_id) <> 'draft'
  AND OLD.case_id NOT IN (SELECT id FROM erasing)
BEGIN
  SELECT RAISE(ABORT, 'only a draft is changed: make a new version');
END;
DROP TRIGGER structure_leaves_a_draft;
CREATE TRIGGER structure_leaves_a_draft BEFORE DELETE ON structure
WHEN OLD.case_id NOT IN (SELECT id FROM erasing) AND (
  (SELECT state FROM training_case WHERE training_case.case_id = OLD.case_id) <> 'draft'
  OR EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = OLD.case_id)
  OR EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = OLD.case_id))
BEGIN
  SELECT RAISE(ABORT, 'only a draft without attempts is changed: make a new version');
END;

-- Whose attempts a study may use: consent to the study stands, or consent to research with the library does and none to
-- the study was withdrawn.
CREATE VIEW consenting AS
SELECT study.study_id, person.person_id
FROM study CROSS JOIN person
WHERE person.erased_us IS NULL AND (
  EXISTS (SELECT 1 FROM consent JOIN consent_text USING (text_id)
    WHERE consent.person_id = person.person_id AND consent_text.study_id = study.study_id AND withdrawn_us IS NULL)
  OR EXISTS (SELECT 1 FROM consent JOIN consent_text USING (text_id)
    WHERE consent.person_id = person.person_id AND consent_text.study_id IS NULL AND withdrawn_us IS NULL)
  AND NOT EXISTS (SELECT 1 FROM consent JOIN consent_text USING (text_id)
    WHERE consent.person_id = person.person_id AND consent_text.study_id = study.study_id));
