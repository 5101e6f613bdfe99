-- Answers that a simulated person gave, or a simulated rater: never taken for a person's.
ALTER TABLE response_set ADD COLUMN simulated INTEGER NOT NULL DEFAULT 0 CHECK (simulated IN (0, 1));
CREATE TRIGGER response_set_stays_simulated BEFORE UPDATE ON response_set WHEN OLD.simulated = 1 AND NEW.simulated = 0
BEGIN
  SELECT RAISE(ABORT, 'what was simulated stays so');
END;
