-- Who rates what, and the how-many-eth it is.
INSERT INTO rating (response_id, round_id, rater, number, view_id, part)
VALUES (:response_id, :round_id, :rater, :number, :view_id, :part)
