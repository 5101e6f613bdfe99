-- Consent to a text, of every version of its study's, stands no longer.
UPDATE consent SET withdrawn_us = max(:withdrawn_us, given_us) -- the clock may have been ahead
WHERE person_id = :person_id AND withdrawn_us IS NULL AND text_id IN (
  SELECT text_id FROM consent_text
  WHERE study_id IS (SELECT study_id FROM consent_text AS one WHERE one.text_id = :text_id))
RETURNING text_id
