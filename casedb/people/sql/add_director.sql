-- Somebody directs a programme from now on.
INSERT INTO programme_director (programme, person_id, from_us)
VALUES (:programme, :person_id, :from_us)
