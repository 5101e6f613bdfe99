-- Whether somebody has answered in a round, or has begun to.
SELECT response_id FROM response_set WHERE round_id = :round_id AND respondent = :respondent
