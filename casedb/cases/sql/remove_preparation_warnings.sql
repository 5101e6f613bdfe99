-- What was told of an earlier preparation of the CT, in a copy of :from_case_id. Its CT may have been denoised by a
-- program that kept no other: then the CT still is, and that warning stays.
DELETE FROM case_warning
WHERE case_id = :case_id AND (
  code IN ('prepared', 'cut_body')
  OR code = 'denoised'
  AND EXISTS (
    SELECT 1 FROM case_preparation AS prepared WHERE prepared.case_id = :from_case_id AND prepared.denoise > 0
  )
  AND position = (
    SELECT max(one.position) FROM case_warning AS one WHERE one.case_id = :case_id AND one.code = 'denoised'
  )
)
