-- The groups of a round, in the order in which they are shown.
SELECT group_name FROM questionnaire_group WHERE round_id = :round_id ORDER BY place
