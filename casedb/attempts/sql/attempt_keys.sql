-- Every attempt, oldest first, by what a list of all of them can be ordered and counted.
SELECT attempt_id, case_id, person_id, started_us, operator_name <> 'person' AS synthetic,
  person_id IN (SELECT person_id FROM person WHERE kind = 'simulated') AS of_simulated
FROM attempt
ORDER BY started_us, attempt_id
