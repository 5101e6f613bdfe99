-- Who proposed a cut, and whether it is frozen.
SELECT proposed_by, frozen_us FROM cut WHERE cut_id = :cut_id
