-- Which person's attempt at which case a rated replay of a study is.
SELECT rating_view.view_id, attempt.case_id, person.pseudonym
FROM rating_view
JOIN attempt USING (attempt_id)
JOIN person USING (person_id)
JOIN questionnaire_round USING (round_id)
WHERE questionnaire_round.study_id = :study_id
