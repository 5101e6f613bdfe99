-- A structure at a position that is free.
INSERT INTO structure (
  structure_id, case_id, position, title, rule, tissue, kind, geometry, hu, labels_sha256, label, created_us
) VALUES (
  :structure_id, :case_id, :position, :title, :rule, :tissue, :kind, :geometry, :hu, :labels_sha256, :label,
  :created_us
)
