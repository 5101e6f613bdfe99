-- What somebody has begun to answer at the workstation.
SELECT response_id FROM desk_response WHERE round_id = :round_id AND person_id = :person_id
