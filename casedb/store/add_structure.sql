-- A structure behind those there are. No row: its title is taken.
INSERT INTO structure (
  structure_id, case_id, position, title, rule, tissue, kind, geometry, hu, labels_sha256, label, created_us
)
SELECT :structure_id, :case_id, coalesce(max(position) + 1, 0), :title, :rule, :tissue, :kind, :geometry, :hu,
  :labels_sha256, :label, :created_us
FROM structure
WHERE case_id = :case_id
