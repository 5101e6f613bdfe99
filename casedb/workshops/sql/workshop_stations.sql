-- The stations of a day.
SELECT title, case_id FROM workshop_station WHERE workshop_id = :workshop_id ORDER BY place
