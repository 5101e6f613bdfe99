-- What became of a step of the procedure.
INSERT INTO attempt_step (
  attempt_id, step_id, version, position, state, t_s, reason, how
) VALUES (
  :attempt_id, :step_id, :version, :position, :state, :t_s, :reason, :how
)
