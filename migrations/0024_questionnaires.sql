-- Questionnaires: a form by its version and language, rounds in which one version is answered under a short code,
-- and what was answered. Nobody's name: a respondent is a code.
CREATE TABLE questionnaire (
  questionnaire_id TEXT NOT NULL PRIMARY KEY,
  form_id TEXT NOT NULL CHECK (form_id <> ''),
  version INTEGER NOT NULL CHECK (version > 0),
  language TEXT NOT NULL CHECK (language <> ''),
  body TEXT NOT NULL CHECK (body <> ''), -- canonical JSON (assessment/questionnaire/form.h)
  body_hash TEXT NOT NULL CHECK (length(body_hash) = 64), -- SHA-256 of body
  stored_us INTEGER NOT NULL
) STRICT;
CREATE UNIQUE INDEX questionnaire_by_form ON questionnaire (form_id, version, language);

CREATE TRIGGER questionnaire_is_immutable BEFORE UPDATE ON questionnaire
BEGIN
  SELECT RAISE(ABORT, 'a questionnaire is not changed: store another version');
END;
CREATE TRIGGER questionnaire_stays BEFORE DELETE ON questionnaire
BEGIN
  SELECT RAISE(ABORT, 'a questionnaire cannot be removed');
END;

-- One version, in whatever language, answered at one occasion.
CREATE TABLE questionnaire_round (
  round_id TEXT NOT NULL PRIMARY KEY,
  code TEXT NOT NULL CHECK (length(code) = 6),
  title TEXT NOT NULL CHECK (title <> ''),
  form_id TEXT NOT NULL,
  version INTEGER NOT NULL,
  study_id TEXT REFERENCES study (study_id), -- null: of no study
  opened_us INTEGER NOT NULL,
  opened_by TEXT REFERENCES person (person_id), -- null: the operator
  closed_us INTEGER -- null: open
) STRICT;
CREATE UNIQUE INDEX questionnaire_round_by_code ON questionnaire_round (code);

-- The groups that a respondent chooses from; none: nobody is asked.
CREATE TABLE questionnaire_group (
  round_id TEXT NOT NULL REFERENCES questionnaire_round (round_id),
  place INTEGER NOT NULL CHECK (place >= 0),
  group_name TEXT NOT NULL CHECK (group_name <> ''),
  PRIMARY KEY (round_id, place)
) STRICT;

CREATE TABLE response_set (
  response_id TEXT NOT NULL PRIMARY KEY,
  round_id TEXT NOT NULL REFERENCES questionnaire_round (round_id),
  questionnaire_id TEXT NOT NULL REFERENCES questionnaire (questionnaire_id),
  respondent TEXT NOT NULL CHECK (respondent <> ''), -- a code, drawn or brought along
  group_name TEXT NOT NULL, -- empty: none
  source TEXT NOT NULL CHECK (source IN ('page', 'paper')),
  draft_key TEXT CHECK (length(draft_key) = 64), -- SHA-256 of what the browser keeps; null: not a draft of a page
  begun_us INTEGER NOT NULL,
  submitted_us INTEGER -- null: a draft
) STRICT;
CREATE UNIQUE INDEX response_set_by_respondent ON response_set (round_id, respondent);
CREATE UNIQUE INDEX response_set_by_draft ON response_set (draft_key);
CREATE INDEX response_set_by_questionnaire ON response_set (questionnaire_id);

CREATE TRIGGER response_set_is_of_the_rounds_version BEFORE INSERT ON response_set
WHEN NOT EXISTS (SELECT 1 FROM questionnaire_round JOIN questionnaire USING (form_id, version)
  WHERE round_id = NEW.round_id AND questionnaire_id = NEW.questionnaire_id)
BEGIN
  SELECT RAISE(ABORT, 'answers are to the version that the round asks');
END;
CREATE TRIGGER response_set_submitted_is_immutable BEFORE UPDATE ON response_set WHEN OLD.submitted_us IS NOT NULL
BEGIN
  SELECT RAISE(ABORT, 'submitted answers cannot be changed');
END;

-- What was not answered, what does not apply and what was answered are told apart.
CREATE TABLE response (
  response_id TEXT NOT NULL REFERENCES response_set (response_id),
  item_id TEXT NOT NULL CHECK (item_id <> ''),
  state TEXT NOT NULL CHECK (state IN ('missing', 'not_applicable', 'answered')),
  value REAL, -- of a scale or a number; of a choice its place, from 1
  body TEXT NOT NULL, -- of a comment
  PRIMARY KEY (response_id, item_id),
  CHECK ((state = 'answered') = (value IS NOT NULL OR body <> ''))
) STRICT;

CREATE TRIGGER response_submitted_is_immutable BEFORE UPDATE ON response
WHEN (SELECT submitted_us FROM response_set WHERE response_id = OLD.response_id) IS NOT NULL
BEGIN
  SELECT RAISE(ABORT, 'submitted answers cannot be changed');
END;
CREATE TRIGGER response_submitted_is_complete BEFORE INSERT ON response
WHEN (SELECT submitted_us FROM response_set WHERE response_id = NEW.response_id) IS NOT NULL
BEGIN
  SELECT RAISE(ABORT, 'submitted answers cannot be added to');
END;
