-- What import kept of the source.
INSERT INTO case_attribute (
  case_id, position, name, value
) VALUES (
  :case_id, :position, :name, :value
)
