-- The answer to an item, in the place of an earlier one.
INSERT INTO response (response_id, item_id, state, value, body)
VALUES (:response_id, :item_id, :state, :value, :body)
ON CONFLICT DO UPDATE SET state = excluded.state, value = excluded.value, body = excluded.body
