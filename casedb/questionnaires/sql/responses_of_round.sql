-- What was submitted in a round.
SELECT response_id, round_id, questionnaire_id, respondent, group_name, source, begun_us, submitted_us
FROM response_set WHERE round_id = :round_id AND submitted_us IS NOT NULL
ORDER BY respondent
