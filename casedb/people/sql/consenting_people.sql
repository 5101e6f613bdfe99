-- Whose attempts a study may use; without one, whose consent to research with this library stands.
SELECT person_id FROM consenting WHERE study_id = :study_id
UNION
SELECT consent.person_id FROM consent JOIN consent_text USING (text_id)
WHERE :study_id IS NULL AND consent_text.study_id IS NULL AND withdrawn_us IS NULL
