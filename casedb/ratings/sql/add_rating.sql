-- Who rates what, and which of the rater's ratings it is.
INSERT INTO rating (response_id, round_id, rater, number, view_id, part)
VALUES (:response_id, :round_id, :rater, :number, :view_id, :part)
