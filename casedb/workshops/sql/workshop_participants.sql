-- Who came and still consents.
SELECT number, person_id, pseudonym, group_name, arrival, came_us
FROM workshop_participant JOIN person USING (person_id) JOIN workshop USING (workshop_id)
WHERE workshop_id = :workshop_id AND EXISTS (SELECT 1 FROM consenting
  WHERE consenting.study_id = workshop.study_id AND consenting.person_id = workshop_participant.person_id)
ORDER BY number
