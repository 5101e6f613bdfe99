-- An attempt that begins.
INSERT INTO open_attempt (
  attempt_id, case_id, lesion_id, person_id, operator_name, seed, program_version, approach, instrument_kind,
  instrument_length_mm, instrument_radius_mm, instrument_inner_radius_mm, instrument_hu, instrument_throw_mm,
  instrument_notch_mm, instrument_dead_tip_mm, picture_modality, picture_depth_mm, picture_width_mm,
  picture_rate_hz, picture_probe, started_us
) VALUES (
  :attempt_id, :case_id, :lesion_id, :person_id, :operator_name, :seed, :program_version, :approach,
  :instrument_kind, :instrument_length_mm, :instrument_radius_mm, :instrument_inner_radius_mm, :instrument_hu,
  :instrument_throw_mm, :instrument_notch_mm, :instrument_dead_tip_mm, :picture_modality, :picture_depth_mm,
  :picture_width_mm, :picture_rate_hz, :picture_probe, :started_us
)
