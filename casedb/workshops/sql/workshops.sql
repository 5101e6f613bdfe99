-- Every day, the newest first.
SELECT workshop_id, code, study_id, title, seed, opened_us, closed_us FROM workshop ORDER BY opened_us DESC, workshop_id DESC
