-- The draft that a browser keeps.
SELECT response_id, round_id, questionnaire_id, respondent, group_name, source, begun_us, submitted_us
FROM response_set WHERE draft_key = :draft_key
