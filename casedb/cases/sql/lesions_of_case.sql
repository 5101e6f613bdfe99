-- Targets of one case, or of every one (:case_id null), oldest first.
SELECT
  lesion_id, case_id, center_x_lps_mm, center_y_lps_mm, center_z_lps_mm, radius_mm, hu, created_us, kind, lesion_kind,
  radius_x_mm, radius_y_mm, radius_z_mm, roughness, seed, adds, edge_mm
FROM lesion
WHERE case_id BETWEEN coalesce(:case_id, '') AND coalesce(:case_id, '~')
ORDER BY case_id, created_us, lesion_id
