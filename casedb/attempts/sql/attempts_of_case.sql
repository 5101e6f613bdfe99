-- How many attempts were made on a case, or are being made.
SELECT
  (SELECT count(*) FROM attempt WHERE case_id = :case_id)
  + (SELECT count(*) FROM open_attempt WHERE case_id = :case_id) AS attempts
