-- What somebody wrote beside a decision goes; the decision stays.
UPDATE case_decision SET note = ''
WHERE person_id = :person_id AND note <> ''
