-- A station is done; once is enough.
INSERT INTO workshop_tick (workshop_id, number, place, ticked_us) VALUES (:workshop_id, :number, :place, :now_us)
ON CONFLICT DO NOTHING
