-- Of each step the newest version, in order.
SELECT step_id, version, state, t_s, reason, how
FROM attempt_step AS this
WHERE attempt_id = :attempt_id
  AND version = (
    SELECT max(version)
    FROM attempt_step AS other
    WHERE other.attempt_id = this.attempt_id AND other.step_id = this.step_id
  )
ORDER BY position
