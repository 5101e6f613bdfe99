-- What is done of a day: by an attempt since somebody came, or ticked.
SELECT number, place FROM workshop_participant
JOIN workshop_station USING (workshop_id)
WHERE workshop_id = :workshop_id AND (
  EXISTS (SELECT 1 FROM workshop_tick WHERE workshop_tick.workshop_id = workshop_participant.workshop_id
    AND workshop_tick.number = workshop_participant.number AND workshop_tick.place = workshop_station.place)
  OR EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = workshop_station.case_id
    AND attempt.person_id = workshop_participant.person_id AND operator_name = :operator AND started_us >= came_us))
