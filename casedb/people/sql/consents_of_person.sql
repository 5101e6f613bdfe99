-- Every text that is asked of :person_id (the newest of each study and of the library) or was ever answered by them,
-- with the answer that stands, else the last one.
SELECT consent_text.text_id, consent_text.study_id, study.title, version, body, body_hash,
  version = (SELECT max(version) FROM consent_text AS one WHERE one.study_id IS consent_text.study_id) AS newest,
  given_us, withdrawn_us
FROM consent_text
LEFT JOIN study ON study.study_id = consent_text.study_id
LEFT JOIN consent ON consent.text_id = consent_text.text_id AND consent.person_id = :person_id AND given_us = (
  SELECT given_us FROM consent AS one
  WHERE one.text_id = consent_text.text_id AND one.person_id = :person_id
  ORDER BY withdrawn_us IS NULL DESC, given_us DESC LIMIT 1)
WHERE newest OR given_us IS NOT NULL
ORDER BY consent_text.study_id IS NOT NULL, study.created_us, consent_text.study_id, version DESC
