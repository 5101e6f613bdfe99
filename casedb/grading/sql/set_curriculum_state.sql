-- Published (then by whom and when) or retired.
UPDATE curriculum SET state = :state, published_by = coalesce(published_by, :published_by),
  published_us = coalesce(published_us, :published_us)
WHERE curriculum_id = :curriculum_id
