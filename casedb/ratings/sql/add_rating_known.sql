-- A known score.
INSERT INTO rating_known (view_id, item_id, value) VALUES (:view_id, :item_id, :value)
