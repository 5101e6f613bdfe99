UPDATE cut SET frozen_by = :frozen_by, frozen_us = :frozen_us WHERE cut_id = :cut_id
