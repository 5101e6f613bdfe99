-- The known scores of a replay.
SELECT item_id, value FROM rating_known WHERE view_id = :view_id ORDER BY item_id
