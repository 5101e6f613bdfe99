-- How the servo kept time in an attempt.
INSERT INTO servo_record (
  attempt_id, tick_s, scheduler, memory_locked, ticks, missed, period, latency, compute
) VALUES (
  :attempt_id, :tick_s, :scheduler, :memory_locked, :ticks, :missed, :period, :latency, :compute
)
