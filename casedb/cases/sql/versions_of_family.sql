-- A case's versions that are or were published, the newest first.
SELECT case_id, title, state, version, audience FROM training_case
WHERE coalesce(family_id, case_id) = :family_id AND state IN ('published', 'retired')
ORDER BY version DESC
