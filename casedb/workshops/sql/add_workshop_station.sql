-- A station of the day.
INSERT INTO workshop_station (workshop_id, place, title, case_id) VALUES (:workshop_id, :place, :title, :case_id)
