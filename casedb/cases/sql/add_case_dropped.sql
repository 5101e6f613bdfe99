-- What of the source did not enter.
INSERT INTO case_dropped (
  case_id, position, tag, keyword, reason, count
) VALUES (
  :case_id, :position, :tag, :keyword, :reason, :count
)
