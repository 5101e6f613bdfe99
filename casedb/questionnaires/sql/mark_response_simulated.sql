-- Nobody's answers: those of a simulated person or rater.
UPDATE response_set SET simulated = 1 WHERE response_id = :response_id
