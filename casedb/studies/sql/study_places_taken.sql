-- How many were ever enrolled.
SELECT coalesce(sum(taken), 0) AS taken FROM study_stratum
WHERE study_id = :study_id
