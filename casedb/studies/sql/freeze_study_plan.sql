-- The draft is the plan from now on.
UPDATE study_plan SET frozen_us = :now_us, frozen_by = :person_id, seed = :seed, seed_hash = :seed_hash
WHERE study_id = :study_id
