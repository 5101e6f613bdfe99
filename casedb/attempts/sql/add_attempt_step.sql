-- What became of a step of the procedure.
INSERT INTO attempt_step (
  attempt_id, step_id, version, position, state, t_s, reason
) VALUES (
  :attempt_id, :step_id, :version, :position, :state, :t_s, :reason
)
