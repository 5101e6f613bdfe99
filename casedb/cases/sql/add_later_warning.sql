-- After those that a case has.
INSERT INTO case_warning (case_id, position, code, text)
VALUES (
  :case_id, (SELECT coalesce(max(position) + 1, 0) FROM case_warning WHERE case_id = :case_id), :code, :text
)
