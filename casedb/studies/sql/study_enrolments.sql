-- Who takes part, in the order in which they came, and whether their consent stands.
SELECT person_id, pseudonym, enrolled_us, group_name, stratum, position,
  EXISTS (SELECT 1 FROM consenting
    WHERE consenting.study_id = study_enrolment.study_id AND consenting.person_id = study_enrolment.person_id) AS consents
FROM study_enrolment JOIN person USING (person_id)
WHERE study_enrolment.study_id = :study_id
ORDER BY enrolled_us, person_id
