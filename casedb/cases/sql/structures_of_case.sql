-- Structures of a case, in their order.
SELECT structure_id, case_id, title, rule, tissue, kind, geometry, hu, labels_sha256, label, position
FROM structure
WHERE case_id = :case_id
ORDER BY position
