-- A new case. Its setting follows (casedb/setting_columns.h); each of its columns has a default.
INSERT INTO training_case (
  case_id, title, state, origin, created_us, size_x_voxels, size_y_voxels, size_z_voxels, spacing_x_mm,
  spacing_y_mm, spacing_z_mm, lps_from_voxel_00, lps_from_voxel_01, lps_from_voxel_02, lps_from_voxel_03,
  lps_from_voxel_10, lps_from_voxel_11, lps_from_voxel_12, lps_from_voxel_13, lps_from_voxel_20,
  lps_from_voxel_21, lps_from_voxel_22, lps_from_voxel_23, hu_min, hu_max, slices_used, volume_sha256,
  skin_sha256, labels_sha256, classes_sha256, family_id, version, face_state, burned_in_checked_us,
  burned_in_checked_by, burned_in_by_operator
) VALUES (
  :case_id, :title, :state, :origin, :created_us, :size_x_voxels, :size_y_voxels, :size_z_voxels,
  :spacing_x_mm, :spacing_y_mm, :spacing_z_mm, :lps_from_voxel_00, :lps_from_voxel_01, :lps_from_voxel_02,
  :lps_from_voxel_03, :lps_from_voxel_10, :lps_from_voxel_11, :lps_from_voxel_12, :lps_from_voxel_13,
  :lps_from_voxel_20, :lps_from_voxel_21, :lps_from_voxel_22, :lps_from_voxel_23, :hu_min, :hu_max,
  :slices_used, :volume_sha256, :skin_sha256, :labels_sha256, :classes_sha256, :family_id, :version, :face_state,
  :burned_in_checked_us, :burned_in_checked_by,
  :burned_in_by_operator
)
