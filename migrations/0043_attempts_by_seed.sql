-- Whether a simulated person's attempt is there is asked of each that is stored, among all that the person has.
CREATE INDEX attempt_by_seed ON attempt (person_id, seed);
