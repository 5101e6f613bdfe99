-- Every round, the newest first, and how many have begun and are done.
SELECT round_id, code, title, form_id, version, study_id, opened_us, opened_by, closed_us, at_desk,
  (SELECT count(*) FROM response_set WHERE response_set.round_id = questionnaire_round.round_id
    AND submitted_us IS NULL) AS drafts,
  (SELECT count(*) FROM response_set WHERE response_set.round_id = questionnaire_round.round_id
    AND submitted_us IS NOT NULL) AS submitted,
  EXISTS (SELECT 1 FROM rating_round WHERE rating_round.round_id = questionnaire_round.round_id) AS rated
FROM questionnaire_round
ORDER BY opened_us DESC, round_id DESC
