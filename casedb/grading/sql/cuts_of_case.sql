-- Oldest first, with who proposed and who froze, by pseudonym.
SELECT cut.*, proposer.pseudonym AS proposer, freezer.pseudonym AS freezer
FROM cut
JOIN person AS proposer ON proposer.person_id = cut.proposed_by
LEFT JOIN person AS freezer ON freezer.person_id = cut.frozen_by
WHERE cut.case_id = :case_id
ORDER BY proposed_us, cut_id
