-- Whether a simulated person's attempt is there is asked of each that is stored, among all that the person has. With
-- what they are sorted by: else attempt_by_person would be taken, and all of theirs read.
CREATE INDEX attempt_by_seed ON attempt (person_id, seed, started_us, attempt_id);
