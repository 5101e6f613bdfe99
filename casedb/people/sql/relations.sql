-- What everybody is to :reader, as far as it is anything.
WITH led AS (
  SELECT cohort_id FROM enrolment
  WHERE person_id = :reader AND post = 'mentor' AND to_us IS NULL
), directed AS (
  SELECT cohort_id FROM cohort JOIN programme_director USING (programme)
  WHERE person_id = :reader AND to_us IS NULL
), learning AS (
  SELECT cohort_id, person_id FROM enrolment
  WHERE post = 'learner' AND to_us IS NULL
), studied AS (
  SELECT consenting.person_id FROM study_researcher JOIN consenting USING (study_id)
  WHERE study_researcher.person_id = :reader AND to_us IS NULL
    -- Who works on a study whose plan is still a draft sees nothing of its people.
    AND NOT EXISTS (SELECT 1 FROM study_plan
      WHERE study_plan.study_id = study_researcher.study_id AND frozen_us IS NULL)
)
SELECT person_id,
  person_id = :reader AS own,
  person_id IN (SELECT learning.person_id FROM learning JOIN led USING (cohort_id)) AS own_cohort,
  person_id IN (SELECT learning.person_id FROM learning JOIN directed USING (cohort_id)) AS own_programme,
  person_id IN (SELECT person_id FROM studied) AS own_study
FROM person
WHERE erased_us IS NULL
