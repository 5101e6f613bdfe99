-- Every questionnaire, by its id, version and language.
SELECT questionnaire_id, form_id, version, language, body, body_hash, stored_us FROM questionnaire
ORDER BY form_id, version, language
