-- What import found odd.
INSERT INTO case_warning (
  case_id, position, code, text
) VALUES (
  :case_id, :position, :code, :text
)
