-- Simulated people of a study, in the order in which they were enrolled.
SELECT person_id, group_name FROM study_enrolment JOIN person USING (person_id)
WHERE study_id = :study_id AND kind = 'simulated' AND erased_us IS NULL
ORDER BY enrolled_us, person_id
