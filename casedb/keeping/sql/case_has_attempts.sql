-- Whether anybody has made or is making an attempt on a case.
SELECT EXISTS (SELECT 1 FROM attempt WHERE case_id = :case_id)
  OR EXISTS (SELECT 1 FROM open_attempt WHERE case_id = :case_id) AS found
