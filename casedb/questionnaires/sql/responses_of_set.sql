-- What somebody has answered.
SELECT item_id, state, value, body FROM response WHERE response_id = :response_id ORDER BY item_id
