-- Whether there is such a case, and such a target in it.
SELECT
  EXISTS (SELECT 1 FROM training_case WHERE case_id = :case_id) AS case_exists,
  EXISTS (SELECT 1 FROM lesion WHERE lesion_id = :lesion_id AND case_id = :case_id) AS lesion_exists
