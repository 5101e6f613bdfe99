-- What is looked up when an attempt or a case is erased, and whenever a standard is asked for.
CREATE INDEX replay_watched_by_attempt ON replay_watched (attempt_id);
CREATE INDEX standard_attempt_by_attempt ON standard_attempt (attempt_id);
CREATE INDEX standard_by_case ON standard (case_id);
