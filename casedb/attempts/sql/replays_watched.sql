-- How often a person has watched attempts at any version of a case: the person's own, and those of others.
SELECT
  count(*) FILTER (WHERE own) AS own,
  count(*) FILTER (WHERE NOT own) AS others
FROM (
  SELECT attempt.person_id IS :person_id AND attempt.operator_name = :person_operator AS own
  FROM replay_watched
  JOIN attempt USING (attempt_id)
  JOIN training_case USING (case_id)
  WHERE replay_watched.person_id = :person_id
    AND coalesce(training_case.family_id, training_case.case_id) = (
      SELECT coalesce(family_id, case_id) FROM training_case WHERE case_id = :case_id)
)
