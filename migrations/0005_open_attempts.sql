-- Attempts are stored while they run, and with how the servo kept time.

-- Why it ended; null: stored before schema 5. Interrupted: the program was gone before it could say.
ALTER TABLE attempt ADD COLUMN end_reason TEXT CHECK (end_reason IN ('fired', 'stopped', 'time_limit', 'device_lost', 'interrupted'));

-- An attempt that runs, or whose program died: as attempt, without what only its end tells.
CREATE TABLE open_attempt (
  attempt_id TEXT NOT NULL PRIMARY KEY CHECK (length(attempt_id) = 36),
  case_id TEXT NOT NULL REFERENCES training_case (case_id),
  lesion_id TEXT NOT NULL,
  person_id TEXT REFERENCES person (person_id),
  operator_name TEXT NOT NULL,
  seed INTEGER NOT NULL,
  program_version TEXT NOT NULL,
  approach TEXT NOT NULL CHECK (approach IN ('in_plane', 'out_of_plane')),
  instrument_kind TEXT NOT NULL CHECK (instrument_kind IN ('access', 'core')),
  instrument_length_mm REAL NOT NULL,
  instrument_radius_mm REAL NOT NULL,
  instrument_inner_radius_mm REAL NOT NULL,
  instrument_hu REAL NOT NULL,
  instrument_throw_mm REAL NOT NULL,
  instrument_notch_mm REAL NOT NULL,
  instrument_dead_tip_mm REAL NOT NULL,
  picture_modality TEXT NOT NULL CHECK (picture_modality IN ('mpr', 'xray', 'ultrasound')),
  picture_depth_mm REAL NOT NULL,
  picture_width_mm REAL NOT NULL,
  picture_rate_hz REAL NOT NULL,
  picture_probe TEXT,
  started_us INTEGER NOT NULL,
  FOREIGN KEY (lesion_id, case_id) REFERENCES lesion (lesion_id, case_id)
) STRICT;

-- What of its recording is there so far.
CREATE TABLE open_chunk (
  attempt_id TEXT NOT NULL REFERENCES open_attempt (attempt_id) ON DELETE CASCADE,
  sequence INTEGER NOT NULL CHECK (sequence >= 0),
  checksum INTEGER NOT NULL,
  data BLOB NOT NULL,
  PRIMARY KEY (attempt_id, sequence)
) STRICT;

-- How the servo kept time during an attempt; of one in virtual time there is none.
CREATE TABLE servo_record (
  attempt_id TEXT NOT NULL PRIMARY KEY REFERENCES attempt (attempt_id),
  tick_s REAL NOT NULL CHECK (tick_s > 0),
  scheduler TEXT NOT NULL CHECK (scheduler IN ('other', 'fifo')),
  memory_locked INTEGER NOT NULL CHECK (memory_locked IN (0, 1)),
  ticks INTEGER NOT NULL CHECK (ticks >= 0),
  missed INTEGER NOT NULL CHECK (missed >= 0),
  period BLOB NOT NULL, -- each a cases::TimeHistogram, compressed
  latency BLOB NOT NULL,
  compute BLOB NOT NULL
) STRICT;

CREATE TRIGGER servo_record_is_immutable BEFORE UPDATE ON servo_record
BEGIN
  SELECT RAISE(ABORT, 'a servo record cannot be changed');
END;

CREATE TRIGGER servo_record_is_kept BEFORE DELETE ON servo_record
BEGIN
  SELECT RAISE(ABORT, 'a servo record cannot be deleted');
END;
