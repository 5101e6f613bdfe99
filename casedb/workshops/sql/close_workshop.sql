-- Nobody comes any more.
UPDATE workshop SET closed_us = :now_us WHERE workshop_id = :workshop_id
