-- What records_of depends on: acts that change what is learnt of everybody, where this person is enrolled, and what
-- they did.
SELECT
  coalesce((SELECT sequence FROM audit
            WHERE act IN ('publish_case', 'retire_case', 'publish_curriculum', 'retire_curriculum', 'import_cases',
                          'erase_case', 'recompute', 'repair', 'accept_damaged', 'restore')
            ORDER BY sequence DESC LIMIT 1), 0) AS everybodys,
  coalesce((SELECT max(sequence) FROM audit
            WHERE object_id = :person_id AND act IN ('enrol', 'end_enrolment')), 0) AS ones,
  (SELECT count(*) FROM attempt WHERE person_id = :person_id) AS attempts,
  coalesce((SELECT attempt_id FROM attempt WHERE person_id = :person_id
            ORDER BY started_us DESC, attempt_id DESC LIMIT 1), '') AS newest,
  (SELECT count(*) FROM open_attempt WHERE person_id = :person_id) AS running
