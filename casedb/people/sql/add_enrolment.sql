-- Somebody belongs to a cohort from now on.
INSERT INTO enrolment (cohort_id, person_id, post, from_us)
VALUES (:cohort_id, :person_id, :post, :from_us)
