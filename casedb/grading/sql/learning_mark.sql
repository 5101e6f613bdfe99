-- What learning_attempts, cohorts and what was done in them depend on: acts that change which attempts there are, how
-- they were scored or who is in which cohort; and attempts.
SELECT
  coalesce((SELECT sequence FROM audit
            WHERE act IN ('make_cohort', 'enrol', 'end_enrolment', 'erase_person', 'erase_attempts', 'erase_case',
                          'recompute', 'repair', 'accept_damaged', 'restore')
            ORDER BY sequence DESC LIMIT 1), 0) AS act,
  coalesce((SELECT max(rowid) FROM attempt), 0) AS attempt
