-- A clock was ahead when these were entered; what is entered now takes their place.
DELETE FROM person_level WHERE person_id = :person_id AND since_us >= :now_us
