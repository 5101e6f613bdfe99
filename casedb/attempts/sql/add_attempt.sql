-- A new attempt.
INSERT INTO attempt (
  attempt_id, case_id, lesion_id, person_id, operator_name, seed, program_version, step_version, approach,
  instrument_kind, instrument_length_mm, instrument_radius_mm, instrument_inner_radius_mm, instrument_hu,
  instrument_throw_mm, instrument_notch_mm, instrument_dead_tip_mm, picture_modality, picture_depth_mm,
  picture_width_mm, picture_rate_hz, started_us, duration_s, state, recording_chunks, picture_sha256,
  picture_probe, end_reason, away_s
) VALUES (
  :attempt_id, :case_id, :lesion_id, :person_id, :operator_name, :seed, :program_version, :step_version,
  :approach, :instrument_kind, :instrument_length_mm, :instrument_radius_mm, :instrument_inner_radius_mm,
  :instrument_hu, :instrument_throw_mm, :instrument_notch_mm, :instrument_dead_tip_mm, :picture_modality,
  :picture_depth_mm, :picture_width_mm, :picture_rate_hz, :started_us, :duration_s, :state, :recording_chunks,
  :picture_sha256, :picture_probe, :end_reason, :away_s
)
