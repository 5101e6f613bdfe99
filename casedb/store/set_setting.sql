-- The setting of a draft.
UPDATE training_case SET
  subject = :subject, modality = :modality, patient_position = :patient_position, further_modalities = :further_modalities,
  approach = :approach, instrument_kind = :instrument_kind, instrument_length_mm = :instrument_length_mm,
  instrument_radius_mm = :instrument_radius_mm, instrument_inner_radius_mm = :instrument_inner_radius_mm,
  instrument_hu = :instrument_hu, instrument_throw_mm = :instrument_throw_mm, instrument_notch_mm =
  :instrument_notch_mm, instrument_dead_tip_mm = :instrument_dead_tip_mm, inr = :inr, platelets_per_nl =
  :platelets_per_nl, allergy = :allergy, indication = :indication, decision = :decision,
  breath_depth = :breath_depth, breath_period_s = :breath_period_s, breath_irregularity = :breath_irregularity,
  tissue_yields = :tissue_yields,
  planned_entry_x_lps_mm = :planned_entry_x_lps_mm, planned_entry_y_lps_mm = :planned_entry_y_lps_mm,
  planned_entry_z_lps_mm = :planned_entry_z_lps_mm, difficulty = :difficulty, time_limit_s = :time_limit_s,
  attempt_limit = :attempt_limit, pass_rule = :pass_rule
WHERE case_id = :case_id
