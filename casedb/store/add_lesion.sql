-- A new target.
INSERT INTO lesion (
  lesion_id, case_id, center_x_lps_mm, center_y_lps_mm, center_z_lps_mm, radius_mm, hu, created_us
) VALUES (
  :lesion_id, :case_id, :center_x_lps_mm, :center_y_lps_mm, :center_z_lps_mm, :radius_mm, :hu, :created_us
)
