-- How many attempts a person has begun on a case, and how many he may; those simulated in somebody's name are
-- nobody's. An item of a published curriculum has a limit in place of the case's own; of several the most generous
-- counts, since an attempt names no curriculum.
WITH of_items AS (
  SELECT coalesce(curriculum_item.attempt_limit, training_case.attempt_limit) AS most
  FROM training_case
  JOIN curriculum_item ON curriculum_item.family_id = coalesce(training_case.family_id, training_case.case_id)
  JOIN curriculum ON curriculum.curriculum_id = curriculum_item.curriculum_id AND curriculum.state = 'published'
  WHERE training_case.case_id = :case_id
)
SELECT
  (SELECT count(*) FROM attempt
   WHERE case_id = :case_id AND person_id = :person_id AND operator_name = 'person')
  + (SELECT count(*) FROM open_attempt
     WHERE case_id = :case_id AND person_id = :person_id AND operator_name = 'person') AS begun,
  CASE
    WHEN NOT EXISTS (SELECT 1 FROM of_items)
      THEN (SELECT attempt_limit FROM training_case WHERE case_id = :case_id)
    WHEN NOT EXISTS (SELECT 1 FROM of_items WHERE most IS NULL) THEN (SELECT max(most) FROM of_items)
  END AS attempt_limit
