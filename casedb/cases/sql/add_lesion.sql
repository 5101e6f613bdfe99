-- A new target.
INSERT INTO lesion (
  lesion_id, case_id, center_x_lps_mm, center_y_lps_mm, center_z_lps_mm, radius_mm, hu, created_us, kind, lesion_kind,
  radius_x_mm, radius_y_mm, radius_z_mm, roughness, seed, adds, edge_mm
) VALUES (
  :lesion_id, :case_id, :center_x_lps_mm, :center_y_lps_mm, :center_z_lps_mm, :radius_mm, :hu, :created_us, :kind, :lesion_kind,
  :radius_x_mm, :radius_y_mm, :radius_z_mm, :roughness, :seed, :adds, :edge_mm
)
