-- How a step was done: by a deed that shows it, or said.
ALTER TABLE attempt_step ADD COLUMN how TEXT CHECK (how IN ('shown', 'said')); -- null: neither, or stored before schema 14
