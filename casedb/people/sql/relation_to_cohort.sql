-- Whether :reader leads a cohort or directs a programme.
SELECT EXISTS (
  SELECT 1 FROM enrolment
  WHERE cohort_id = :cohort_id AND person_id = :reader AND post = 'mentor' AND to_us IS NULL
) AS leads, EXISTS (
  SELECT 1 FROM programme_director
  WHERE programme = :programme AND person_id = :reader AND to_us IS NULL
) AS directs
