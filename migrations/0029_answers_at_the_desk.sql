-- Questionnaires at the workstation: a round is asked of whoever logs in there, after an attempt of theirs. Whose
-- answers these are the library knows; who reads them learns a code.
ALTER TABLE questionnaire_round ADD COLUMN at_desk INTEGER NOT NULL DEFAULT 0 CHECK (at_desk IN (0, 1));

CREATE TABLE desk_response (
  response_id TEXT NOT NULL PRIMARY KEY REFERENCES response_set (response_id) DEFERRABLE INITIALLY DEFERRED,
  round_id TEXT NOT NULL REFERENCES questionnaire_round (round_id),
  person_id TEXT NOT NULL REFERENCES person (person_id)
) STRICT;
CREATE UNIQUE INDEX desk_response_by_round ON desk_response (round_id, person_id); -- once each
CREATE INDEX desk_response_by_person ON desk_response (person_id);

CREATE TRIGGER desk_response_is_immutable BEFORE UPDATE ON desk_response
BEGIN
  SELECT RAISE(ABORT, 'whose answers these are is not changed');
END;
CREATE TRIGGER desk_response_is_kept BEFORE DELETE ON desk_response
WHEN OLD.person_id NOT IN (SELECT id FROM erasing)
BEGIN
  SELECT RAISE(ABORT, 'answers cannot be deleted');
END;
-- With a person go their answers.
CREATE TRIGGER desk_response_goes_with_its_answers BEFORE DELETE ON desk_response
WHEN OLD.person_id IN (SELECT id FROM erasing)
BEGIN
  DELETE FROM response WHERE response_id = OLD.response_id;
  DELETE FROM response_set WHERE response_id = OLD.response_id;
END;
