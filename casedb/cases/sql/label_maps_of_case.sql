-- Label maps that came after the case, in their order.
SELECT labels_sha256, wins FROM case_label_map
WHERE case_id = :case_id
ORDER BY position
