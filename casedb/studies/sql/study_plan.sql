-- A study's plan.
SELECT body, body_hash, stored_us, frozen_us, frozen_by, seed, seed_hash FROM study_plan
WHERE study_id = :study_id
