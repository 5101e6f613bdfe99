-- A structure, for a new version.
INSERT INTO structure (
  structure_id, case_id, position, title, rule, tissue, kind, geometry, hu, labels_sha256, label, created_us
)
SELECT :structure_id, :case_id, position, title, rule, tissue, kind, geometry, hu, labels_sha256, label, created_us
FROM structure
WHERE structure_id = :from_structure_id
