-- Nobody begins or goes on from now on.
UPDATE questionnaire_round SET closed_us = :now_us WHERE round_id = :round_id
