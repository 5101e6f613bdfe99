-- What was submitted in a round; of a study's, at the workstation, by those whose consent stands.
SELECT response_set.response_id, response_set.round_id, questionnaire_id, respondent, group_name,
  CASE WHEN simulated THEN 'simulated' WHEN person_id IS NULL THEN source ELSE 'window' END AS source, begun_us, submitted_us
FROM response_set LEFT JOIN desk_response ON desk_response.response_id = response_set.response_id
WHERE response_set.round_id = :round_id AND submitted_us IS NOT NULL
  AND (person_id IS NULL OR :study_id IS NULL OR EXISTS (SELECT 1 FROM consenting
    WHERE consenting.study_id = :study_id AND consenting.person_id = desk_response.person_id))
ORDER BY respondent
