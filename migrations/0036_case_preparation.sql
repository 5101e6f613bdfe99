-- How the CT of a case was prepared (docs/decisions/0080); a case without a row is as its CT came.
CREATE TABLE case_preparation (
  case_id TEXT NOT NULL PRIMARY KEY REFERENCES training_case (case_id) ON DELETE CASCADE,
  original_sha256 TEXT NOT NULL CHECK (length(original_sha256) = 64), -- the volume before, a file of assets/
  clamp_low_hu REAL NOT NULL CHECK (clamp_low_hu BETWEEN -1024 AND -500),
  clamp_high_hu REAL NOT NULL CHECK (clamp_high_hu BETWEEN 500 AND 32767),
  denoise REAL NOT NULL CHECK (denoise BETWEEN 0 AND 30),
  shrink_i REAL NOT NULL CHECK (shrink_i BETWEEN 1 AND 8),
  shrink_j REAL NOT NULL CHECK (shrink_j BETWEEN 1 AND 8),
  shrink_k REAL NOT NULL CHECK (shrink_k BETWEEN 1 AND 8),
  skin_hu REAL NOT NULL CHECK (skin_hu BETWEEN -900 AND -50),
  skin_grid_mm REAL NOT NULL CHECK (skin_grid_mm BETWEEN 0.5 AND 10),
  skin_smooth REAL NOT NULL CHECK (skin_smooth BETWEEN 0 AND 100),
  skin_decimate REAL NOT NULL CHECK (skin_decimate BETWEEN 0 AND 0.98)
) STRICT;

CREATE TRIGGER case_preparation_is_kept BEFORE UPDATE ON case_preparation
BEGIN
  SELECT RAISE(ABORT, 'how the CT of a case was prepared cannot be changed');
END;
