-- Whether :reader leads a cohort or directs a programme at :now_us.
SELECT EXISTS (
  SELECT 1 FROM enrolment
  WHERE cohort_id = :cohort_id AND person_id = :reader AND post = 'mentor'
    AND from_us <= :now_us AND (to_us IS NULL OR to_us > :now_us)
) AS leads, EXISTS (
  SELECT 1 FROM programme_director
  WHERE programme = :programme AND person_id = :reader AND from_us <= :now_us AND (to_us IS NULL OR to_us > :now_us)
) AS directs
