-- Consent to a study that was never given and is withdrawn at once: consent to research with the library, which covers
-- every study, does not cover this one. Nothing where the study was answered before; the row that comes back tells.
INSERT INTO consent (person_id, text_id, given_us, withdrawn_us)
SELECT :person_id, text_id, :now_us, :now_us FROM consent_text AS asked
WHERE text_id = :text_id AND study_id IS NOT NULL
  AND EXISTS (SELECT 1 FROM consent JOIN consent_text USING (text_id)
    WHERE consent.person_id = :person_id AND consent_text.study_id IS NULL AND withdrawn_us IS NULL)
  AND NOT EXISTS (SELECT 1 FROM consent JOIN consent_text USING (text_id)
    WHERE consent.person_id = :person_id AND consent_text.study_id = asked.study_id)
RETURNING text_id
