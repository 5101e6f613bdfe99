-- Whether somebody has made or is making an attempt.
SELECT EXISTS (SELECT 1 FROM attempt WHERE person_id = :person_id)
  OR EXISTS (SELECT 1 FROM open_attempt WHERE person_id = :person_id) AS found
