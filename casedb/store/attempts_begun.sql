-- How many attempts a person has begun on a case; those simulated in somebody's name are nobody's.
SELECT
  (SELECT count(*) FROM attempt
   WHERE case_id = :case_id AND person_id = :person_id AND operator_name = 'person')
  + (SELECT count(*) FROM open_attempt
     WHERE case_id = :case_id AND person_id = :person_id AND operator_name = 'person') AS begun,
  (SELECT attempt_limit FROM training_case WHERE case_id = :case_id) AS attempt_limit
