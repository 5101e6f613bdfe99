-- Somebody begins to answer.
INSERT INTO response_set (response_id, round_id, questionnaire_id, respondent, group_name, source, draft_key, begun_us)
VALUES (:response_id, :round_id, :questionnaire_id, :respondent, :group_name, :source, :draft_key, :now_us)
