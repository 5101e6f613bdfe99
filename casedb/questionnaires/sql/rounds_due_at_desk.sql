-- What somebody is to answer at the workstation: after an attempt of theirs, while their consent stands, once; no
-- round that simulated people answer.
SELECT round_id FROM questionnaire_round
WHERE at_desk = 1 AND closed_us IS NULL
  AND (study_id IS NULL OR EXISTS (SELECT 1 FROM consenting
    WHERE consenting.study_id = questionnaire_round.study_id AND consenting.person_id = :person_id))
  AND EXISTS (SELECT 1 FROM attempt WHERE attempt.person_id = :person_id AND operator_name = :operator
    AND started_us >= opened_us)
  AND NOT EXISTS (SELECT 1 FROM desk_response JOIN response_set USING (response_id)
    WHERE desk_response.round_id = questionnaire_round.round_id AND person_id = :person_id
      AND submitted_us IS NOT NULL)
  AND NOT EXISTS (SELECT 1 FROM response_set
    WHERE response_set.round_id = questionnaire_round.round_id AND simulated = 1)
ORDER BY opened_us, round_id
