-- Every rating of a round, by rater and in their order; of a study's round only what people consent to, or nobody
-- made.
SELECT rating.response_id, rating.rater, rating.number, rating.view_id, rating.part, rating_view.attempt_id,
  rating_view.sheet_sha256, response_set.submitted_us, response_set.simulated
FROM rating
JOIN rating_view USING (view_id)
JOIN response_set USING (response_id)
JOIN questionnaire_round ON questionnaire_round.round_id = rating.round_id
JOIN attempt USING (attempt_id)
WHERE rating.round_id = :round_id
  AND (questionnaire_round.study_id IS NULL OR attempt.person_id IS NULL
    OR EXISTS (SELECT 1 FROM consenting WHERE consenting.study_id = questionnaire_round.study_id
      AND consenting.person_id = attempt.person_id))
ORDER BY length(rating.rater), rating.rater, rating.number
