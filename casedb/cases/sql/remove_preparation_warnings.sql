-- What was told of an earlier preparation of the CT.
DELETE FROM case_warning
WHERE case_id = :case_id AND code IN ('prepared', 'denoised', 'cut_body')
