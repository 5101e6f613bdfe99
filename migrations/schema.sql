-- The sum of the numbered steps beside this file: what a new library is made of. Written by casedb_database_test.

CREATE TABLE account (
  person_id TEXT NOT NULL PRIMARY KEY REFERENCES person (person_id),
  role TEXT NOT NULL CHECK (role IN ('trainee', 'mentor', 'researcher', 'director', 'admin')),
  password_hash TEXT NOT NULL CHECK (password_hash LIKE '$argon2id$%'),
  enabled INTEGER NOT NULL CHECK (enabled IN (0, 1)),
  created_us INTEGER NOT NULL
, epoch INTEGER NOT NULL DEFAULT 0 CHECK (epoch >= 0)) STRICT;

CREATE TABLE asked_event (
  attempt_id TEXT NOT NULL REFERENCES open_attempt (attempt_id) ON DELETE CASCADE,
  position INTEGER NOT NULL CHECK (position BETWEEN 0 AND 999),
  kind TEXT NOT NULL CHECK (kind IN ('cough', 'bleeding', 'pressure_drop')),
  taken INTEGER NOT NULL DEFAULT 0 CHECK (taken IN (0, 1)),
  PRIMARY KEY (attempt_id, position)
) STRICT, WITHOUT ROWID;

CREATE TABLE attempt (
  attempt_id TEXT NOT NULL PRIMARY KEY CHECK (length(attempt_id) = 36),
  case_id TEXT NOT NULL REFERENCES training_case (case_id),
  lesion_id TEXT NOT NULL,
  person_id TEXT REFERENCES person (person_id), -- null: a simulation of nobody
  operator_name TEXT NOT NULL, -- 'person', or the simulated operator
  seed INTEGER NOT NULL, -- the 64 bits of an unsigned number, read as a signed one
  program_version TEXT NOT NULL,
  step_version INTEGER NOT NULL CHECK (step_version >= 0), -- replay needs the same
  approach TEXT NOT NULL CHECK (approach IN ('in_plane', 'out_of_plane')),
  instrument_kind TEXT NOT NULL CHECK (instrument_kind IN ('access', 'core')),
  instrument_length_mm REAL NOT NULL,
  instrument_radius_mm REAL NOT NULL,
  instrument_inner_radius_mm REAL NOT NULL, -- 0: solid
  instrument_hu REAL NOT NULL,
  instrument_throw_mm REAL NOT NULL,
  instrument_notch_mm REAL NOT NULL,
  instrument_dead_tip_mm REAL NOT NULL,
  picture_modality TEXT NOT NULL CHECK (picture_modality IN ('mpr', 'xray', 'ultrasound')),
  picture_depth_mm REAL NOT NULL,
  picture_width_mm REAL NOT NULL,
  picture_rate_hz REAL NOT NULL,
  started_us INTEGER NOT NULL,
  duration_s REAL NOT NULL CHECK (duration_s >= 0),
  state TEXT NOT NULL CHECK (state IN ('complete', 'unfinished')), -- complete: the trigger fell
  recording_chunks INTEGER NOT NULL CHECK (recording_chunks > 0), -- how many belong to it
  picture_sha256 TEXT CHECK (length(picture_sha256) = 64), -- PNG in assets/ at the trigger; null: none
  picture_probe TEXT, end_reason TEXT CHECK (end_reason IN ('fired', 'stopped', 'time_limit', 'device_lost', 'interrupted')), away_s REAL CHECK (away_s >= 0), -- of ultrasound; null: another modality
  FOREIGN KEY (lesion_id, case_id) REFERENCES lesion (lesion_id, case_id)
) STRICT;

CREATE TABLE attempt_comment (
  attempt_id TEXT NOT NULL REFERENCES attempt (attempt_id),
  comment_id TEXT NOT NULL,
  at_s REAL NOT NULL CHECK (at_s >= 0), -- since the attempt began
  body TEXT NOT NULL CHECK (body <> ''),
  person_id TEXT REFERENCES person (person_id), -- null: the operator
  written_us INTEGER NOT NULL,
  PRIMARY KEY (attempt_id, comment_id)
) STRICT;

CREATE TABLE attempt_condition (
  attempt_id TEXT NOT NULL REFERENCES attempt (attempt_id),
  condition_id TEXT NOT NULL,
  number REAL,
  words TEXT,
  PRIMARY KEY (attempt_id, condition_id),
  CHECK ((number IS NULL) <> (words IS NULL))
) STRICT, WITHOUT ROWID;

CREATE TABLE attempt_step (
  attempt_id TEXT NOT NULL REFERENCES attempt (attempt_id),
  step_id TEXT NOT NULL,
  version INTEGER NOT NULL CHECK (version > 0),
  position INTEGER NOT NULL CHECK (position >= 0), -- the order in which they are to be done
  state TEXT NOT NULL CHECK (state IN ('done', 'skipped', 'violated', 'not_asked')),
  t_s REAL, -- when it was done, too late or violated; null: never
  reason TEXT NOT NULL, how TEXT CHECK (how IN ('shown', 'said')), -- why it was not asked for; else empty
  PRIMARY KEY (attempt_id, step_id, version),
  CHECK ((state = 'not_asked') = (reason <> ''))
) STRICT, WITHOUT ROWID;

CREATE TABLE audit (
  sequence INTEGER NOT NULL PRIMARY KEY CHECK (sequence > 0),
  at_us INTEGER NOT NULL,
  actor TEXT NOT NULL CHECK (actor IN ('nobody', 'operator', 'person')),
  -- Who acted, or in whose name the operator did; null: nobody's.
  person_id TEXT REFERENCES person (person_id) CHECK (actor <> 'person' OR person_id IS NOT NULL),
  act TEXT NOT NULL CHECK (act <> '' AND act NOT GLOB '*[^a-z_]*'), -- a code of casedb/database/audit.h
  object TEXT NOT NULL CHECK (object NOT GLOB '*[^a-z_]*'), -- what kind of thing; empty: none
  object_id TEXT NOT NULL CHECK (length(object_id) <= 36 AND object_id NOT GLOB '*[^0-9a-z_-]*'),
  result TEXT NOT NULL CHECK (result IN ('done', 'refused')),
  hash TEXT NOT NULL CHECK (length(hash) = 64) -- SHA-256 of the row and of the hash before it
) STRICT;

CREATE TABLE audit_head (
  id INTEGER NOT NULL PRIMARY KEY CHECK (id = 1),
  count INTEGER NOT NULL CHECK (count >= 0),
  hash TEXT NOT NULL CHECK (length(hash) = 64)
) STRICT;

CREATE TABLE case_attribute (
  case_id TEXT NOT NULL REFERENCES training_case (case_id),
  position INTEGER NOT NULL CHECK (position >= 0), -- order in which they are shown
  name TEXT NOT NULL,
  value TEXT NOT NULL,
  PRIMARY KEY (case_id, position),
  UNIQUE (case_id, name)
) STRICT;

CREATE TABLE case_cohort (
  case_id TEXT NOT NULL REFERENCES training_case (case_id) ON DELETE CASCADE,
  cohort_id TEXT NOT NULL REFERENCES cohort (cohort_id),
  PRIMARY KEY (case_id, cohort_id)
) STRICT;

CREATE TABLE case_decision (
  case_id TEXT NOT NULL REFERENCES training_case (case_id),
  position INTEGER NOT NULL CHECK (position >= 0),
  decision TEXT NOT NULL CHECK (decision IN ('made', 'submitted', 'returned', 'approved', 'published', 'retired')),
  person_id TEXT NOT NULL REFERENCES person (person_id),
  note TEXT NOT NULL,
  decided_us INTEGER NOT NULL, by_operator INTEGER CHECK (by_operator IN (0, 1)),
  PRIMARY KEY (case_id, position)
) STRICT;

CREATE TABLE case_dropped (
  case_id TEXT NOT NULL REFERENCES training_case (case_id) ON DELETE CASCADE,
  position INTEGER NOT NULL CHECK (position >= 0),
  tag TEXT NOT NULL,
  keyword TEXT NOT NULL, -- of the de-identification table; empty where it has none
  reason TEXT NOT NULL CHECK (reason IN ('not_on_the_list', 'private', 'value_not_accepted')),
  count INTEGER NOT NULL CHECK (count > 0),
  PRIMARY KEY (case_id, position)
) STRICT;

CREATE TABLE case_label_map (
  case_id TEXT NOT NULL REFERENCES training_case (case_id),
  position INTEGER NOT NULL CHECK (position >= 0),
  labels_sha256 TEXT NOT NULL CHECK (length(labels_sha256) = 64), -- a file of assets/
  created_us INTEGER NOT NULL, wins INTEGER NOT NULL DEFAULT 0 CHECK (wins IN (0, 1)),
  PRIMARY KEY (case_id, position),
  UNIQUE (case_id, labels_sha256)
) STRICT;

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

CREATE TABLE case_received (
  case_id TEXT NOT NULL PRIMARY KEY REFERENCES training_case (case_id) ON DELETE CASCADE,
  received_us INTEGER NOT NULL,
  state TEXT NOT NULL CHECK (state IN ('draft', 'review', 'published', 'retired')),
  face_state TEXT NOT NULL CHECK (face_state IN ('unchecked', 'none', 'cropped', 'defaced')),
  burned_in_checked_us INTEGER, -- null: the sender does not say that anybody looked
  signing_key TEXT CHECK (length(signing_key) = 64) -- the public key, in hexadecimal; null: unsigned
) STRICT;

CREATE TABLE case_warning (
  case_id TEXT NOT NULL REFERENCES training_case (case_id),
  position INTEGER NOT NULL CHECK (position >= 0),
  code TEXT NOT NULL,
  text TEXT NOT NULL,
  PRIMARY KEY (case_id, position)
) STRICT;

CREATE TABLE cohort (
  cohort_id TEXT NOT NULL PRIMARY KEY CHECK (length(cohort_id) = 36),
  title TEXT NOT NULL UNIQUE CHECK (title <> ''),
  programme TEXT NOT NULL CHECK (programme <> ''),
  site TEXT NOT NULL, -- empty: not said
  created_us INTEGER NOT NULL
) STRICT;

CREATE TABLE consent (
  person_id TEXT NOT NULL REFERENCES person (person_id),
  text_id TEXT NOT NULL REFERENCES consent_text (text_id),
  given_us INTEGER NOT NULL,
  withdrawn_us INTEGER CHECK (withdrawn_us >= given_us), -- null: it stands
  PRIMARY KEY (person_id, text_id, given_us)
) STRICT;

CREATE TABLE consent_text (
  text_id TEXT NOT NULL PRIMARY KEY CHECK (length(text_id) = 36),
  study_id TEXT REFERENCES study (study_id), -- null: research with this library, whatever the study
  version INTEGER NOT NULL CHECK (version > 0),
  body TEXT NOT NULL CHECK (body <> ''),
  body_hash TEXT NOT NULL CHECK (length(body_hash) = 64), -- SHA-256 of body
  created_us INTEGER NOT NULL
) STRICT;

CREATE TABLE curriculum (
  curriculum_id TEXT NOT NULL PRIMARY KEY CHECK (length(curriculum_id) = 36),
  title TEXT NOT NULL CHECK (title <> ''),
  state TEXT NOT NULL CHECK (state IN ('draft', 'published', 'retired')),
  made_by TEXT NOT NULL REFERENCES person (person_id),
  made_us INTEGER NOT NULL,
  published_by TEXT REFERENCES person (person_id),
  published_us INTEGER,
  CHECK ((published_by IS NULL) = (published_us IS NULL) AND (state <> 'published' OR published_us IS NOT NULL))
) STRICT;

CREATE TABLE curriculum_gate (
  curriculum_id TEXT NOT NULL,
  position INTEGER NOT NULL,
  after_position INTEGER NOT NULL CHECK (after_position < position),
  reached TEXT NOT NULL CHECK (reached IN ('passed', 'proficient')),
  PRIMARY KEY (curriculum_id, position, after_position),
  FOREIGN KEY (curriculum_id, position) REFERENCES curriculum_item (curriculum_id, position) ON DELETE CASCADE,
  FOREIGN KEY (curriculum_id, after_position) REFERENCES curriculum_item (curriculum_id, position) ON DELETE CASCADE
) STRICT;

CREATE TABLE curriculum_item (
  curriculum_id TEXT NOT NULL REFERENCES curriculum (curriculum_id) ON DELETE CASCADE,
  position INTEGER NOT NULL CHECK (position BETWEEN 1 AND 1000),
  family_id TEXT NOT NULL CHECK (length(family_id) = 36), -- as training_case.family_id
  attempt_limit INTEGER CHECK (attempt_limit BETWEEN 1 AND 1000), -- null: the case's own
  PRIMARY KEY (curriculum_id, position),
  UNIQUE (curriculum_id, family_id)
) STRICT;

CREATE TABLE cut (
  cut_id TEXT NOT NULL PRIMARY KEY CHECK (length(cut_id) = 36),
  case_id TEXT NOT NULL REFERENCES training_case (case_id),
  metric_id TEXT CHECK (metric_id <> ''), -- null: of a share of items, as judges of Angoff's method have it
  version INTEGER CHECK (version > 0), -- of the metric
  higher_is_better INTEGER NOT NULL CHECK (higher_is_better IN (0, 1)),
  method TEXT NOT NULL CHECK (method IN ('contrasting_groups', 'borderline', 'angoff', 'hofstee')),
  options TEXT NOT NULL, -- of the method: k=v,k=v
  data TEXT NOT NULL CHECK (data <> ''), -- CSV, columns value, group, subject, rater, x as far as given
  value REAL NOT NULL,
  low REAL, -- both null: there is no interval
  high REAL CHECK (high >= low),
  n INTEGER NOT NULL CHECK (n > 0), -- persons or judges that it rests on
  words TEXT NOT NULL CHECK (words <> ''), -- the method in words, with what was chosen
  proposed_by TEXT NOT NULL REFERENCES person (person_id),
  proposed_us INTEGER NOT NULL,
  frozen_by TEXT REFERENCES person (person_id),
  frozen_us INTEGER,
  CHECK ((metric_id IS NULL) = (version IS NULL)),
  CHECK ((low IS NULL) = (high IS NULL)),
  CHECK ((frozen_by IS NULL) = (frozen_us IS NULL)),
  CHECK (frozen_by IS NULL OR frozen_by <> proposed_by)
) STRICT;

CREATE TABLE desk_response (
  response_id TEXT NOT NULL PRIMARY KEY REFERENCES response_set (response_id) DEFERRABLE INITIALLY DEFERRED,
  round_id TEXT NOT NULL REFERENCES questionnaire_round (round_id),
  person_id TEXT NOT NULL REFERENCES person (person_id)
) STRICT;

CREATE TABLE digest (
  of_table TEXT NOT NULL,
  of_id TEXT NOT NULL, -- the first column of the rows; of what an attempt has many of, the first two
  sum INTEGER NOT NULL, -- XOR of the rows' digests (casedb/database/digests.h)
  PRIMARY KEY (of_table, of_id)
) STRICT, WITHOUT ROWID;

CREATE TABLE enrolment (
  cohort_id TEXT NOT NULL REFERENCES cohort (cohort_id),
  person_id TEXT NOT NULL REFERENCES person (person_id),
  post TEXT NOT NULL CHECK (post IN ('learner', 'mentor')),
  from_us INTEGER NOT NULL,
  to_us INTEGER CHECK (to_us >= from_us), -- null: still
  PRIMARY KEY (cohort_id, person_id, post, from_us)
) STRICT;

CREATE TABLE erased_attempt (
  erasure_id TEXT NOT NULL REFERENCES erasure (erasure_id),
  position INTEGER NOT NULL CHECK (position >= 0),
  case_id TEXT NOT NULL, -- may be gone by now
  PRIMARY KEY (erasure_id, position)
) STRICT;

CREATE TABLE erasing (
  id TEXT NOT NULL PRIMARY KEY -- of an attempt, a case or a person
) STRICT;

CREATE TABLE erasure (
  erasure_id TEXT NOT NULL PRIMARY KEY CHECK (length(erasure_id) = 36),
  what TEXT NOT NULL CHECK (what IN ('person', 'attempts', 'case')), -- attempts: of a person who stays, or one
  erased_us INTEGER NOT NULL,
  by_person_id TEXT REFERENCES person (person_id) -- null: whoever has the library's files
) STRICT;

CREATE TABLE lesion (
  lesion_id TEXT NOT NULL PRIMARY KEY CHECK (length(lesion_id) = 36),
  case_id TEXT NOT NULL REFERENCES training_case (case_id),
  center_x_lps_mm REAL NOT NULL,
  center_y_lps_mm REAL NOT NULL,
  center_z_lps_mm REAL NOT NULL,
  radius_mm REAL NOT NULL CHECK (radius_mm > 0),
  hu REAL NOT NULL,
  created_us INTEGER NOT NULL, kind TEXT NOT NULL DEFAULT 'sphere'
  CHECK (kind IN ('sphere', 'ellipsoid', 'irregular')), radius_x_mm REAL CHECK ((kind = 'ellipsoid') = (coalesce(radius_x_mm, 0) > 0)), radius_y_mm REAL CHECK ((kind = 'ellipsoid') = (coalesce(radius_y_mm, 0) > 0)), radius_z_mm REAL CHECK ((kind = 'ellipsoid') = (coalesce(radius_z_mm, 0) > 0)), roughness REAL NOT NULL DEFAULT 0.0 CHECK (roughness >= 0), seed INTEGER NOT NULL DEFAULT 1, adds INTEGER NOT NULL DEFAULT 0 CHECK (adds IN (0, 1)), edge_mm REAL NOT NULL DEFAULT 0.0 CHECK (edge_mm >= 0), lesion_kind TEXT NOT NULL DEFAULT 'by_hu'
  CHECK (lesion_kind IN ('by_hu', 'cyst', 'hcc', 'metastasis', 'haemangioma', 'abscess', 'node', 'isoechoic')),
  UNIQUE (lesion_id, case_id) -- so that an attempt's lesion is one of its case
) STRICT;

CREATE TABLE login_session (
  token_hash TEXT NOT NULL PRIMARY KEY CHECK (length(token_hash) = 64), -- SHA-256; the token has only its owner
  person_id TEXT NOT NULL REFERENCES person (person_id),
  password_mark TEXT NOT NULL, -- of the password, role and epoch that began it
  begun_us INTEGER NOT NULL,
  ends_us INTEGER NOT NULL CHECK (ends_us > begun_us)
) STRICT;

CREATE TABLE metric_value (
  attempt_id TEXT NOT NULL REFERENCES attempt (attempt_id),
  metric_id TEXT NOT NULL,
  version INTEGER NOT NULL CHECK (version > 0),
  position INTEGER NOT NULL CHECK (position >= 0), -- order in which they are shown
  value REAL CHECK (value BETWEEN -1.7976931348623157e308 AND 1.7976931348623157e308), -- in unit; null is not 0
  unit TEXT NOT NULL,
  reason TEXT NOT NULL, -- why there is no value; empty when there is one
  PRIMARY KEY (attempt_id, metric_id, version),
  CHECK ((value IS NULL) = (reason <> ''))
) STRICT, WITHOUT ROWID;

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
  started_us INTEGER NOT NULL, away_s REAL CHECK (away_s >= 0),
  FOREIGN KEY (lesion_id, case_id) REFERENCES lesion (lesion_id, case_id)
) STRICT;

CREATE TABLE open_attempt_condition (
  attempt_id TEXT NOT NULL REFERENCES open_attempt (attempt_id) ON DELETE CASCADE,
  condition_id TEXT NOT NULL,
  number REAL,
  words TEXT,
  PRIMARY KEY (attempt_id, condition_id),
  CHECK ((number IS NULL) <> (words IS NULL))
) STRICT, WITHOUT ROWID;

CREATE TABLE open_chunk (
  attempt_id TEXT NOT NULL REFERENCES open_attempt (attempt_id) ON DELETE CASCADE,
  sequence INTEGER NOT NULL CHECK (sequence >= 0),
  checksum INTEGER NOT NULL,
  data BLOB NOT NULL, stored_us INTEGER,
  PRIMARY KEY (attempt_id, sequence)
) STRICT;

CREATE TABLE password_link (
  secret_hash TEXT NOT NULL PRIMARY KEY CHECK (length(secret_hash) = 64), -- SHA-256; the link has only who was given it
  person_id TEXT NOT NULL REFERENCES person (person_id),
  password_mark TEXT NOT NULL, -- of the password, role and epoch at which it was made
  ends_us INTEGER NOT NULL
) STRICT;

CREATE TABLE person (
  person_id TEXT NOT NULL PRIMARY KEY CHECK (length(person_id) = 36),
  pseudonym TEXT NOT NULL UNIQUE, -- random; what others than mentors see
  created_us INTEGER NOT NULL
, erased_us INTEGER, kind TEXT NOT NULL DEFAULT 'real' CHECK (kind IN ('real', 'simulated'))) STRICT;

CREATE TABLE person_fact (
  person_id TEXT NOT NULL REFERENCES person (person_id),
  fact_id TEXT NOT NULL,
  given_us INTEGER NOT NULL,
  answer TEXT NOT NULL CHECK (answer <> ''),
  PRIMARY KEY (person_id, fact_id, given_us)
) STRICT;

CREATE TABLE person_level (
  person_id TEXT NOT NULL REFERENCES person (person_id),
  since_us INTEGER NOT NULL,
  level TEXT NOT NULL CHECK (level IN ('student', 'trainee', 'consultant')),
  PRIMARY KEY (person_id, since_us)
) STRICT;

CREATE TABLE programme_director (
  programme TEXT NOT NULL CHECK (programme <> ''), -- as cohort.programme
  person_id TEXT NOT NULL REFERENCES person (person_id),
  from_us INTEGER NOT NULL,
  to_us INTEGER CHECK (to_us >= from_us),
  PRIMARY KEY (programme, person_id, from_us)
) STRICT;

CREATE TABLE questionnaire (
  questionnaire_id TEXT NOT NULL PRIMARY KEY,
  form_id TEXT NOT NULL CHECK (form_id <> ''),
  version INTEGER NOT NULL CHECK (version > 0),
  language TEXT NOT NULL CHECK (language <> ''),
  body TEXT NOT NULL CHECK (body <> ''), -- canonical JSON (assessment/questionnaire/form.h)
  body_hash TEXT NOT NULL CHECK (length(body_hash) = 64), -- SHA-256 of body
  stored_us INTEGER NOT NULL
) STRICT;

CREATE TABLE questionnaire_group (
  round_id TEXT NOT NULL REFERENCES questionnaire_round (round_id),
  place INTEGER NOT NULL CHECK (place >= 0),
  group_name TEXT NOT NULL CHECK (group_name <> ''),
  PRIMARY KEY (round_id, place)
) STRICT;

CREATE TABLE questionnaire_round (
  round_id TEXT NOT NULL PRIMARY KEY,
  code TEXT NOT NULL CHECK (length(code) = 6),
  title TEXT NOT NULL CHECK (title <> ''),
  form_id TEXT NOT NULL,
  version INTEGER NOT NULL,
  study_id TEXT REFERENCES study (study_id), -- null: of no study
  opened_us INTEGER NOT NULL,
  opened_by TEXT REFERENCES person (person_id), -- null: the operator
  closed_us INTEGER -- null: open
, at_desk INTEGER NOT NULL DEFAULT 0 CHECK (at_desk IN (0, 1))) STRICT;

CREATE TABLE rating (
  response_id TEXT NOT NULL PRIMARY KEY REFERENCES response_set (response_id) DEFERRABLE INITIALLY DEFERRED,
  round_id TEXT NOT NULL,
  rater TEXT NOT NULL,
  number INTEGER NOT NULL CHECK (number > 0), -- in this rater's order, and all that they see of which replay it is
  view_id TEXT NOT NULL REFERENCES rating_view (view_id) DEFERRABLE INITIALLY DEFERRED,
  part TEXT NOT NULL CHECK (part IN ('calibration', 'rated', 'repeated')),
  FOREIGN KEY (round_id, rater) REFERENCES rating_rater (round_id, rater)
) STRICT;

CREATE TABLE rating_known (
  view_id TEXT NOT NULL REFERENCES rating_view (view_id) DEFERRABLE INITIALLY DEFERRED,
  item_id TEXT NOT NULL CHECK (item_id <> ''),
  value REAL NOT NULL,
  PRIMARY KEY (view_id, item_id)
) STRICT;

CREATE TABLE rating_rater (
  round_id TEXT NOT NULL REFERENCES rating_round (round_id),
  rater TEXT NOT NULL CHECK (rater <> ''), -- "R1"
  key_hash TEXT NOT NULL CHECK (length(key_hash) = 64), -- SHA-256 of what opens the bench
  PRIMARY KEY (round_id, rater)
) STRICT;

CREATE TABLE rating_round (
  round_id TEXT NOT NULL PRIMARY KEY REFERENCES questionnaire_round (round_id),
  each INTEGER NOT NULL CHECK (each > 0), -- as many raters rate a replay
  seed TEXT NOT NULL CHECK (length(seed) = 16) -- of who rates what in which order; whoever rates is not told
) STRICT;

CREATE TABLE rating_view (
  view_id TEXT NOT NULL PRIMARY KEY,
  round_id TEXT NOT NULL REFERENCES rating_round (round_id),
  attempt_id TEXT NOT NULL REFERENCES attempt (attempt_id),
  calibration INTEGER NOT NULL CHECK (calibration IN (0, 1)),
  sheet_sha256 TEXT NOT NULL CHECK (length(sheet_sha256) = 64)
) STRICT;

CREATE TABLE recording_chunk (
  attempt_id TEXT NOT NULL REFERENCES attempt (attempt_id),
  sequence INTEGER NOT NULL CHECK (sequence >= 0),
  checksum INTEGER NOT NULL, -- base::hash_bytes of data; 64 bits as in attempt.seed
  data BLOB NOT NULL, -- compressed
  PRIMARY KEY (attempt_id, sequence)
) STRICT;

CREATE TABLE replay_watched (
  person_id TEXT NOT NULL REFERENCES person (person_id),
  attempt_id TEXT NOT NULL REFERENCES attempt (attempt_id),
  watched_us INTEGER NOT NULL,
  PRIMARY KEY (person_id, attempt_id, watched_us)
) STRICT, WITHOUT ROWID;

CREATE TABLE response (
  response_id TEXT NOT NULL REFERENCES response_set (response_id),
  item_id TEXT NOT NULL CHECK (item_id <> ''),
  state TEXT NOT NULL CHECK (state IN ('missing', 'not_applicable', 'answered')),
  value REAL, -- of a scale or a number; of a choice its place, from 1
  body TEXT NOT NULL, -- of a comment
  PRIMARY KEY (response_id, item_id),
  CHECK ((state = 'answered') = (value IS NOT NULL OR body <> ''))
) STRICT;

CREATE TABLE response_set (
  response_id TEXT NOT NULL PRIMARY KEY,
  round_id TEXT NOT NULL REFERENCES questionnaire_round (round_id),
  questionnaire_id TEXT NOT NULL REFERENCES questionnaire (questionnaire_id),
  respondent TEXT NOT NULL CHECK (respondent <> ''), -- a code, drawn or brought along
  group_name TEXT NOT NULL, -- empty: none
  source TEXT NOT NULL CHECK (source IN ('page', 'paper')),
  draft_key TEXT CHECK (length(draft_key) = 64), -- SHA-256 of what the browser keeps; null: not a draft of a page
  begun_us INTEGER NOT NULL,
  submitted_us INTEGER -- null: a draft
, simulated INTEGER NOT NULL DEFAULT 0 CHECK (simulated IN (0, 1))) STRICT;

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

CREATE TABLE simulated_truth (
  person_id TEXT NOT NULL PRIMARY KEY REFERENCES person (person_id),
  people_version INTEGER NOT NULL CHECK (people_version > 0), -- of the model (assessment/population/person.h)
  seed INTEGER NOT NULL, -- as attempt.seed
  group_name TEXT NOT NULL CHECK (group_name <> ''),
  number INTEGER NOT NULL CHECK (number > 0), -- of the person in seed and group
  eye_hand REAL NOT NULL, -- abilities before practice, in the population's standard deviations
  spatial REAL NOT NULL,
  planning REAL NOT NULL,
  conduct REAL NOT NULL,
  strategy REAL NOT NULL, -- towards fast and rough
  UNIQUE (people_version, seed, group_name, number)
) STRICT;

CREATE TABLE standard (
  standard_id TEXT NOT NULL PRIMARY KEY CHECK (length(standard_id) = 36),
  case_id TEXT NOT NULL REFERENCES training_case (case_id),
  lesion_id TEXT NOT NULL,
  picture_modality TEXT NOT NULL CHECK (picture_modality IN ('mpr', 'xray', 'ultrasound')),
  approach TEXT NOT NULL CHECK (approach IN ('in_plane', 'out_of_plane')),
  instrument_kind TEXT NOT NULL CHECK (instrument_kind IN ('access', 'core')),
  set_id TEXT NOT NULL CHECK (set_id <> ''), -- tells the attempts and the versions of metrics it was made of
  people INTEGER NOT NULL CHECK (people > 0),
  attempts INTEGER NOT NULL CHECK (attempts >= people),
  newest_us INTEGER NOT NULL, -- when the last of the attempts began
  set_by TEXT NOT NULL REFERENCES person (person_id),
  set_us INTEGER NOT NULL,
  FOREIGN KEY (lesion_id, case_id) REFERENCES lesion (lesion_id, case_id)
) STRICT;

CREATE TABLE standard_attempt (
  standard_id TEXT NOT NULL REFERENCES standard (standard_id) ON DELETE CASCADE,
  attempt_id TEXT NOT NULL REFERENCES attempt (attempt_id) ON DELETE CASCADE,
  PRIMARY KEY (standard_id, attempt_id)
) STRICT, WITHOUT ROWID;

CREATE TABLE standard_band (
  standard_id TEXT NOT NULL REFERENCES standard (standard_id) ON DELETE CASCADE,
  position INTEGER NOT NULL CHECK (position >= 0), -- order in which they are shown
  metric_id TEXT NOT NULL,
  version INTEGER NOT NULL CHECK (version > 0),
  unit TEXT NOT NULL,
  people INTEGER NOT NULL CHECK (people > 1), -- those who have a value
  low REAL NOT NULL,
  high REAL NOT NULL CHECK (high >= low),
  mean REAL NOT NULL,
  sd REAL NOT NULL CHECK (sd >= 0),
  tolerance_low REAL, -- both null: of a yes and no
  tolerance_high REAL CHECK (tolerance_high >= tolerance_low),
  PRIMARY KEY (standard_id, metric_id),
  CHECK ((tolerance_low IS NULL) = (tolerance_high IS NULL))
) STRICT, WITHOUT ROWID;

CREATE TABLE structure (
  structure_id TEXT NOT NULL PRIMARY KEY CHECK (length(structure_id) = 36),
  case_id TEXT NOT NULL REFERENCES training_case (case_id),
  position INTEGER NOT NULL CHECK (position >= 0), -- later ones are painted over earlier ones
  title TEXT NOT NULL CHECK (title <> ''),
  rule TEXT NOT NULL CHECK (rule IN ('advisory', 'major', 'critical', 'must_cross', 'organ', 'target')),
  tissue TEXT NOT NULL CHECK (tissue <> ''),
  kind TEXT NOT NULL CHECK (kind IN ('class', 'label', 'drawn')),
  geometry TEXT CHECK (geometry <> ''), -- drawn: casedb/structure_json.h
  hu REAL, -- drawn: what is painted; null: what the CT says stays
  labels_sha256 TEXT CHECK (length(labels_sha256) = 64), -- label: the case's own map or one of case_label_map
  label INTEGER CHECK (label BETWEEN 1 AND 255),
  created_us INTEGER NOT NULL,
  UNIQUE (case_id, position),
  UNIQUE (case_id, title),
  CHECK ((kind = 'drawn') = (geometry IS NOT NULL) AND (kind = 'drawn' OR hu IS NULL)),
  CHECK ((kind = 'label') = (labels_sha256 IS NOT NULL) AND (kind = 'label') = (label IS NOT NULL))
) STRICT;

CREATE TABLE study (
  study_id TEXT NOT NULL PRIMARY KEY CHECK (length(study_id) = 36),
  title TEXT NOT NULL UNIQUE CHECK (title <> ''),
  created_us INTEGER NOT NULL
) STRICT;

CREATE TABLE study_deviation (
  study_id TEXT NOT NULL REFERENCES study (study_id),
  number INTEGER NOT NULL CHECK (number > 0),
  at_us INTEGER NOT NULL,
  actor TEXT NOT NULL CHECK (actor IN ('nobody', 'operator', 'person')),
  person_id TEXT REFERENCES person (person_id),
  body TEXT NOT NULL CHECK (body <> ''),
  PRIMARY KEY (study_id, number)
) STRICT;

CREATE TABLE study_enrolment (
  study_id TEXT NOT NULL REFERENCES study (study_id),
  person_id TEXT NOT NULL REFERENCES person (person_id),
  enrolled_us INTEGER NOT NULL,
  group_name TEXT NOT NULL CHECK (group_name <> ''),
  stratum TEXT NOT NULL,
  position INTEGER NOT NULL CHECK (position >= 0), -- in the stratum's sequence
  PRIMARY KEY (study_id, person_id)
) STRICT;

CREATE TABLE study_lock (
  study_id TEXT NOT NULL PRIMARY KEY REFERENCES study (study_id),
  locked_us INTEGER NOT NULL,
  actor TEXT NOT NULL CHECK (actor IN ('nobody', 'operator', 'person')),
  person_id TEXT REFERENCES person (person_id),
  data_hash TEXT NOT NULL CHECK (length(data_hash) = 64), -- SHA-256 of every value that was analysed then
  people INTEGER NOT NULL CHECK (people >= 0) -- with a value or a failure at a primary outcome
) STRICT;

CREATE TABLE study_look (
  study_id TEXT NOT NULL REFERENCES study (study_id),
  number INTEGER NOT NULL CHECK (number > 0),
  at_us INTEGER NOT NULL,
  actor TEXT NOT NULL CHECK (actor IN ('nobody', 'operator', 'person')),
  person_id TEXT REFERENCES person (person_id),
  query TEXT NOT NULL CHECK (query <> ''),
  people INTEGER NOT NULL CHECK (people >= 0), -- with a value or a failure at a primary outcome by then
  PRIMARY KEY (study_id, number)
) STRICT;

CREATE TABLE study_plan (
  study_id TEXT NOT NULL PRIMARY KEY REFERENCES study (study_id),
  body TEXT NOT NULL CHECK (body <> ''), -- canonical JSON (assessment/study/plan.h)
  body_hash TEXT NOT NULL CHECK (length(body_hash) = 64), -- SHA-256 of body
  stored_us INTEGER NOT NULL,
  frozen_us INTEGER, -- null: a draft
  frozen_by TEXT REFERENCES person (person_id), -- null: the operator
  seed TEXT CHECK (length(seed) = 64), -- of the allocation, drawn when the plan is frozen; never shown while it runs
  seed_hash TEXT CHECK (length(seed_hash) = 64) -- SHA-256 of seed: shown, so that nobody can choose another later
) STRICT;

CREATE TABLE study_researcher (
  study_id TEXT NOT NULL REFERENCES study (study_id),
  person_id TEXT NOT NULL REFERENCES person (person_id),
  from_us INTEGER NOT NULL,
  to_us INTEGER CHECK (to_us >= from_us),
  PRIMARY KEY (study_id, person_id, from_us)
) STRICT;

CREATE TABLE study_stratum (
  study_id TEXT NOT NULL REFERENCES study (study_id),
  stratum TEXT NOT NULL, -- "handedness=right"; empty: there is one
  taken INTEGER NOT NULL CHECK (taken > 0),
  PRIMARY KEY (study_id, stratum)
) STRICT;

CREATE TABLE training_case (
  case_id TEXT NOT NULL PRIMARY KEY CHECK (length(case_id) = 36),
  title TEXT NOT NULL, -- given by a person, never by the source
  state TEXT NOT NULL CHECK (state IN ('draft', 'review', 'published', 'retired')),
  origin TEXT NOT NULL CHECK (origin = 'import' OR origin LIKE 'phantom:%'),
  created_us INTEGER NOT NULL,
  size_x_voxels INTEGER NOT NULL CHECK (size_x_voxels > 0),
  size_y_voxels INTEGER NOT NULL CHECK (size_y_voxels > 0),
  size_z_voxels INTEGER NOT NULL CHECK (size_z_voxels > 0),
  spacing_x_mm REAL NOT NULL CHECK (spacing_x_mm > 0),
  spacing_y_mm REAL NOT NULL CHECK (spacing_y_mm > 0),
  spacing_z_mm REAL NOT NULL CHECK (spacing_z_mm > 0),
  -- mm from voxel index, of voxel centres: row and column from 0; the last row is 0 0 0 1
  lps_from_voxel_00 REAL NOT NULL,
  lps_from_voxel_01 REAL NOT NULL,
  lps_from_voxel_02 REAL NOT NULL,
  lps_from_voxel_03 REAL NOT NULL,
  lps_from_voxel_10 REAL NOT NULL,
  lps_from_voxel_11 REAL NOT NULL,
  lps_from_voxel_12 REAL NOT NULL,
  lps_from_voxel_13 REAL NOT NULL,
  lps_from_voxel_20 REAL NOT NULL,
  lps_from_voxel_21 REAL NOT NULL,
  lps_from_voxel_22 REAL NOT NULL,
  lps_from_voxel_23 REAL NOT NULL,
  hu_min INTEGER NOT NULL,
  hu_max INTEGER NOT NULL CHECK (hu_max >= hu_min),
  slices_used INTEGER NOT NULL CHECK (slices_used >= 0),
  -- names of files in assets/
  volume_sha256 TEXT NOT NULL CHECK (length(volume_sha256) = 64),
  skin_sha256 TEXT NOT NULL CHECK (length(skin_sha256) = 64),
  labels_sha256 TEXT CHECK (length(labels_sha256) = 64), -- null: no labels
  modality TEXT NOT NULL DEFAULT 'mpr' CHECK (modality IN ('mpr', 'xray', 'ultrasound')), -- what it is practised with
  classes_sha256 TEXT CHECK (length(classes_sha256) = 64) -- null: from before schema 3
, patient_position TEXT NOT NULL DEFAULT 'supine'
  CHECK (patient_position IN ('supine', 'prone', 'lateral_left', 'lateral_right')), further_modalities TEXT NOT NULL DEFAULT '', approach TEXT NOT NULL DEFAULT 'in_plane'
  CHECK (approach IN ('in_plane', 'out_of_plane')), instrument_kind TEXT NOT NULL DEFAULT 'access'
  CHECK (instrument_kind IN ('access', 'core')), instrument_length_mm REAL NOT NULL DEFAULT 200.0 CHECK (instrument_length_mm > 0), instrument_radius_mm REAL NOT NULL DEFAULT 0.36 CHECK (instrument_radius_mm > 0), instrument_inner_radius_mm REAL NOT NULL DEFAULT 0.0, instrument_hu REAL NOT NULL DEFAULT 3000.0, instrument_throw_mm REAL NOT NULL DEFAULT 22.0 CHECK (instrument_throw_mm >= 0), instrument_notch_mm REAL NOT NULL DEFAULT 18.0 CHECK (instrument_notch_mm >= 0), instrument_dead_tip_mm REAL NOT NULL DEFAULT 4.0
  CHECK (instrument_dead_tip_mm >= 0), inr REAL CHECK (inr > 0), platelets_per_nl REAL CHECK (platelets_per_nl >= 0), allergy TEXT NOT NULL DEFAULT '', indication TEXT NOT NULL DEFAULT '', decision TEXT NOT NULL DEFAULT 'proceed' CHECK (decision IN ('proceed', 'defer')), planned_entry_x_lps_mm REAL, planned_entry_y_lps_mm REAL, planned_entry_z_lps_mm REAL
  CHECK ((planned_entry_x_lps_mm IS NULL) = (planned_entry_z_lps_mm IS NULL)
    AND (planned_entry_y_lps_mm IS NULL) = (planned_entry_z_lps_mm IS NULL)), difficulty TEXT NOT NULL DEFAULT 'moderate'
  CHECK (difficulty IN ('easy', 'moderate', 'hard')), time_limit_s REAL CHECK (time_limit_s > 0), attempt_limit INTEGER CHECK (attempt_limit BETWEEN 1 AND 1000), pass_rule TEXT CHECK (pass_rule <> ''), family_id TEXT CHECK (length(family_id) = 36), version INTEGER NOT NULL DEFAULT 1
  CHECK (version BETWEEN 1 AND 1000000 AND (version = 1) = (family_id IS NULL)), audience TEXT NOT NULL DEFAULT 'everyone'
  CHECK (audience IN ('everyone', 'own_cohort')), face_state TEXT NOT NULL DEFAULT 'unchecked'
  CHECK (face_state IN ('unchecked', 'none', 'cropped', 'defaced')), burned_in_checked_us INTEGER, burned_in_checked_by TEXT REFERENCES person (person_id) ON DELETE SET NULL
  CHECK (burned_in_checked_by IS NULL OR burned_in_checked_us IS NOT NULL), breath_period_s REAL NOT NULL DEFAULT 4.0 CHECK (breath_period_s BETWEEN 1 AND 20), breath_irregularity REAL NOT NULL DEFAULT 0.1
  CHECK (breath_irregularity BETWEEN 0 AND 0.4), tissue_yields INTEGER NOT NULL DEFAULT 0 CHECK (tissue_yields IN (0, 1)), subject TEXT NOT NULL DEFAULT 'patient' CHECK (subject IN ('patient', 'phantom')), burned_in_by_operator INTEGER CHECK (burned_in_by_operator IN (0, 1)), ct_breath TEXT NOT NULL DEFAULT 'expiration'
  CHECK (ct_breath IN ('expiration', 'inspiration')), breath_depth REAL NOT NULL DEFAULT 0.0
  CHECK (breath_depth BETWEEN 0 AND 3), probe_is_chosen INTEGER NOT NULL DEFAULT 0 CHECK (probe_is_chosen IN (0, 1)), instrument_tip TEXT NOT NULL DEFAULT 'bevel'
  CHECK (instrument_tip IN ('bevel', 'diamond', 'trocar', 'core')), touch_law TEXT NOT NULL DEFAULT 'steady'
  CHECK (touch_law IN ('steady', 'by_speed', 'organs_move')), breath_law TEXT NOT NULL DEFAULT 'equal_holds'
  CHECK (breath_law IN ('equal_holds', 'drifting_holds', 'sliding_organs')), sight_law TEXT NOT NULL DEFAULT 'half_slice'
  CHECK (sight_law IN ('half_slice', 'echo', 'scatter', 'clutter', 'material', 'tilt'))) STRICT;

CREATE TABLE trusted_key (
  public_key TEXT NOT NULL PRIMARY KEY CHECK (length(public_key) = 64),
  label TEXT NOT NULL UNIQUE CHECK (label <> ''),
  added_us INTEGER NOT NULL
) STRICT;

CREATE TABLE web_session (
  id_hash TEXT NOT NULL PRIMARY KEY CHECK (length(id_hash) = 64), -- SHA-256; the id has only the browser
  port INTEGER NOT NULL, -- of the server that began it
  person_id TEXT NOT NULL REFERENCES person (person_id),
  password_mark TEXT NOT NULL, -- of the password, role and epoch that began it
  begun_us INTEGER NOT NULL,
  seen_us INTEGER NOT NULL CHECK (seen_us >= begun_us), -- last; written once a minute
  ends_us INTEGER NOT NULL CHECK (ends_us > begun_us)
) STRICT;

CREATE TABLE workshop (
  workshop_id TEXT NOT NULL PRIMARY KEY,
  code TEXT NOT NULL CHECK (length(code) = 6), -- opens the board
  study_id TEXT NOT NULL REFERENCES study (study_id),
  title TEXT NOT NULL CHECK (title <> ''),
  seed INTEGER NOT NULL, -- of the orders in which people go
  opened_us INTEGER NOT NULL,
  opened_by TEXT REFERENCES person (person_id), -- null: the operator
  closed_us INTEGER -- null: open
) STRICT;

CREATE TABLE workshop_group (
  workshop_id TEXT NOT NULL REFERENCES workshop (workshop_id),
  place INTEGER NOT NULL CHECK (place >= 0),
  group_name TEXT NOT NULL CHECK (group_name <> ''),
  PRIMARY KEY (workshop_id, place)
) STRICT;

CREATE TABLE workshop_participant (
  workshop_id TEXT NOT NULL REFERENCES workshop (workshop_id),
  number INTEGER NOT NULL CHECK (number > 0), -- what somebody is on the board
  person_id TEXT NOT NULL REFERENCES person (person_id),
  group_name TEXT NOT NULL, -- empty: none
  arrival INTEGER NOT NULL CHECK (arrival >= 0), -- as which of their group they came: which order is theirs
  came_us INTEGER NOT NULL,
  PRIMARY KEY (workshop_id, number)
) STRICT;

CREATE TABLE workshop_station (
  workshop_id TEXT NOT NULL REFERENCES workshop (workshop_id),
  place INTEGER NOT NULL CHECK (place >= 0),
  title TEXT NOT NULL CHECK (title <> ''),
  case_id TEXT, -- done by an attempt at it; null: it is ticked. May be gone by now
  PRIMARY KEY (workshop_id, place)
) STRICT;

CREATE TABLE workshop_tick (
  workshop_id TEXT NOT NULL,
  number INTEGER NOT NULL,
  place INTEGER NOT NULL,
  ticked_us INTEGER NOT NULL,
  PRIMARY KEY (workshop_id, number, place),
  FOREIGN KEY (workshop_id, number) REFERENCES workshop_participant (workshop_id, number) ON DELETE CASCADE,
  FOREIGN KEY (workshop_id, place) REFERENCES workshop_station (workshop_id, place)
) STRICT;

INSERT INTO audit_head VALUES (1, 0, '0000000000000000000000000000000000000000000000000000000000000000');

CREATE INDEX attempt_by_case ON attempt (case_id);

CREATE INDEX attempt_by_person ON attempt (person_id, started_us, attempt_id);

CREATE INDEX attempt_by_seed ON attempt (person_id, seed, started_us, attempt_id);

CREATE INDEX attempt_by_time ON attempt (started_us, attempt_id);

CREATE INDEX attempt_comment_by_person ON attempt_comment (person_id);

CREATE INDEX audit_by_object ON audit (object_id, act);

CREATE INDEX audit_of_changes ON audit (sequence)
WHERE act NOT IN ('log_in', 'log_out', 'let_in_again', 'unproven', 'not_allowed', 'comment_attempt');

CREATE INDEX audit_of_everybodys_records ON audit (sequence)
WHERE act IN ('publish_case', 'retire_case', 'publish_curriculum', 'retire_curriculum', 'import_cases', 'erase_case',
              'recompute', 'repair', 'accept_damaged', 'restore');

CREATE UNIQUE INDEX consent_stands_once ON consent (person_id, text_id) WHERE withdrawn_us IS NULL;

CREATE UNIQUE INDEX consent_text_version ON consent_text (coalesce(study_id, ''), version);

CREATE INDEX cut_by_case ON cut (case_id);

CREATE INDEX desk_response_by_person ON desk_response (person_id);

CREATE UNIQUE INDEX desk_response_by_round ON desk_response (round_id, person_id);

CREATE INDEX enrolment_by_person ON enrolment (person_id);

CREATE INDEX lesion_by_case ON lesion (case_id);

CREATE INDEX metric_value_hit ON metric_value (attempt_id, version, value) WHERE metric_id = 'hit';

CREATE INDEX password_link_of_person ON password_link (person_id);

CREATE UNIQUE INDEX questionnaire_by_form ON questionnaire (form_id, version, language);

CREATE UNIQUE INDEX questionnaire_round_by_code ON questionnaire_round (code);

CREATE UNIQUE INDEX rating_by_number ON rating (round_id, rater, number);

CREATE INDEX rating_by_view ON rating (view_id);

CREATE UNIQUE INDEX rating_rater_by_key ON rating_rater (key_hash);

CREATE INDEX rating_view_by_attempt ON rating_view (attempt_id);

CREATE INDEX rating_view_by_round ON rating_view (round_id);

CREATE INDEX replay_watched_by_attempt ON replay_watched (attempt_id);

CREATE UNIQUE INDEX response_set_by_draft ON response_set (draft_key);

CREATE INDEX response_set_by_questionnaire ON response_set (questionnaire_id);

CREATE UNIQUE INDEX response_set_by_respondent ON response_set (round_id, respondent);

CREATE INDEX standard_attempt_by_attempt ON standard_attempt (attempt_id);

CREATE INDEX standard_by_case ON standard (case_id);

CREATE INDEX study_enrolment_by_person ON study_enrolment (person_id);

CREATE UNIQUE INDEX study_enrolment_place ON study_enrolment (study_id, stratum, position);

CREATE UNIQUE INDEX training_case_version ON training_case (coalesce(family_id, case_id), version);

CREATE INDEX web_session_of_person ON web_session (person_id);

CREATE UNIQUE INDEX workshop_by_code ON workshop (code);

CREATE UNIQUE INDEX workshop_participant_by_person ON workshop_participant (workshop_id, person_id);

CREATE INDEX workshop_participant_of_person ON workshop_participant (person_id);

CREATE INDEX workshop_tick_by_station ON workshop_tick (workshop_id, place);

CREATE VIEW attempt_summary AS
SELECT attempt.*, training_case.title AS case_title, lesion.center_x_lps_mm, lesion.center_y_lps_mm,
  lesion.center_z_lps_mm, lesion.radius_mm, lesion.hu AS lesion_hu
FROM attempt
JOIN training_case ON training_case.case_id = attempt.case_id
JOIN lesion ON lesion.lesion_id = attempt.lesion_id;

CREATE VIEW consenting AS
SELECT study.study_id, person.person_id
FROM study CROSS JOIN person
WHERE person.erased_us IS NULL AND (
  person.kind = 'simulated' AND EXISTS (SELECT 1 FROM study_plan
    WHERE study_plan.study_id = study.study_id AND instr(study_plan.body, '"people":"simulated"') > 0)
  OR EXISTS (SELECT 1 FROM consent JOIN consent_text USING (text_id)
    WHERE consent.person_id = person.person_id AND consent_text.study_id = study.study_id AND withdrawn_us IS NULL)
  OR EXISTS (SELECT 1 FROM consent JOIN consent_text USING (text_id)
    WHERE consent.person_id = person.person_id AND consent_text.study_id IS NULL AND withdrawn_us IS NULL)
  AND NOT EXISTS (SELECT 1 FROM consent JOIN consent_text USING (text_id)
    WHERE consent.person_id = person.person_id AND consent_text.study_id = study.study_id));

CREATE VIEW expert_attempt AS
SELECT attempt_id, case_id, CASE operator_name WHEN 'person' THEN 'consultants' ELSE 'simulated' END AS kind
FROM attempt
WHERE operator_name = 'expert' OR operator_name = 'person' AND person_id IS NOT NULL AND 'consultant' = (
  SELECT level FROM person_level
  WHERE person_level.person_id = attempt.person_id AND since_us <= attempt.started_us
  ORDER BY since_us DESC LIMIT 1);

CREATE TRIGGER attempt_comment_is_immutable BEFORE UPDATE ON attempt_comment
BEGIN
  SELECT RAISE(ABORT, 'a comment is not changed');
END;

CREATE TRIGGER attempt_condition_is_immutable BEFORE UPDATE ON attempt_condition
BEGIN
  SELECT RAISE(ABORT, 'a condition of an attempt cannot be changed');
END;

CREATE TRIGGER attempt_condition_is_kept BEFORE DELETE ON attempt_condition
WHEN OLD.attempt_id NOT IN (SELECT id FROM erasing)
BEGIN
  SELECT RAISE(ABORT, 'a condition of an attempt cannot be deleted');
END;

CREATE TRIGGER attempt_is_immutable BEFORE UPDATE ON attempt
BEGIN
  SELECT RAISE(ABORT, 'an attempt cannot be changed');
END;

CREATE TRIGGER attempt_is_kept BEFORE DELETE ON attempt
WHEN OLD.attempt_id NOT IN (SELECT id FROM erasing)
BEGIN
  SELECT RAISE(ABORT, 'an attempt cannot be deleted');
END;

CREATE TRIGGER attempt_step_is_immutable BEFORE UPDATE ON attempt_step
BEGIN
  SELECT RAISE(ABORT, 'a step of an attempt cannot be changed');
END;

CREATE TRIGGER attempt_step_is_kept BEFORE DELETE ON attempt_step
WHEN OLD.attempt_id NOT IN (SELECT id FROM erasing)
BEGIN
  SELECT RAISE(ABORT, 'a step of an attempt cannot be deleted');
END;

CREATE TRIGGER audit_goes_on BEFORE INSERT ON audit
WHEN NEW.sequence <> (SELECT count + 1 FROM audit_head)
BEGIN
  SELECT RAISE(ABORT, 'the audit log is only written at its end');
END;

CREATE TRIGGER audit_head_goes_on BEFORE UPDATE ON audit_head
WHEN NEW.id <> 1 OR NEW.count <> OLD.count + 1
BEGIN
  SELECT RAISE(ABORT, 'the audit log only grows');
END;

CREATE TRIGGER audit_head_is_kept BEFORE DELETE ON audit_head
BEGIN
  SELECT RAISE(ABORT, 'the audit log cannot be deleted');
END;

CREATE TRIGGER audit_is_immutable BEFORE UPDATE ON audit
BEGIN
  SELECT RAISE(ABORT, 'the audit log cannot be changed');
END;

CREATE TRIGGER audit_is_kept BEFORE DELETE ON audit
BEGIN
  SELECT RAISE(ABORT, 'the audit log cannot be deleted');
END;

CREATE TRIGGER case_decision_is_immutable BEFORE UPDATE ON case_decision
WHEN OLD.person_id NOT IN (SELECT id FROM erasing) OR NEW.note <> '' OR OLD.case_id <> NEW.case_id
  OR OLD.position <> NEW.position OR OLD.decision <> NEW.decision OR OLD.person_id <> NEW.person_id
  OR OLD.decided_us <> NEW.decided_us OR OLD.by_operator IS NOT NEW.by_operator
BEGIN
  SELECT RAISE(ABORT, 'a decision cannot be changed');
END;

CREATE TRIGGER case_decision_is_kept BEFORE DELETE ON case_decision
WHEN OLD.case_id NOT IN (SELECT id FROM erasing)
BEGIN
  SELECT RAISE(ABORT, 'a decision cannot be deleted');
END;

CREATE TRIGGER case_preparation_is_kept BEFORE UPDATE ON case_preparation
BEGIN
  SELECT RAISE(ABORT, 'how the CT of a case was prepared cannot be changed');
END;

CREATE TRIGGER case_received_is_immutable BEFORE UPDATE ON case_received
BEGIN
  SELECT RAISE(ABORT, 'what a sender said cannot be changed');
END;

CREATE TRIGGER consent_is_kept BEFORE DELETE ON consent
BEGIN
  SELECT RAISE(ABORT, 'a consent cannot be deleted');
END;

CREATE TRIGGER consent_is_only_withdrawn BEFORE UPDATE ON consent
WHEN OLD.withdrawn_us IS NOT NULL OR NEW.withdrawn_us IS NULL OR OLD.person_id <> NEW.person_id
  OR OLD.text_id <> NEW.text_id OR OLD.given_us <> NEW.given_us
BEGIN
  SELECT RAISE(ABORT, 'a consent is withdrawn once and not changed otherwise');
END;

CREATE TRIGGER consent_text_is_immutable BEFORE UPDATE ON consent_text
BEGIN
  SELECT RAISE(ABORT, 'a consent text cannot be changed: make a new version');
END;

CREATE TRIGGER consent_text_is_kept BEFORE DELETE ON consent_text
BEGIN
  SELECT RAISE(ABORT, 'a consent text cannot be deleted');
END;

CREATE TRIGGER curriculum_gate_comes_to_a_draft BEFORE INSERT ON curriculum_gate
WHEN (SELECT state FROM curriculum WHERE curriculum.curriculum_id = NEW.curriculum_id) <> 'draft'
BEGIN
  SELECT RAISE(ABORT, 'a published curriculum is not changed: make another');
END;

CREATE TRIGGER curriculum_gate_is_immutable BEFORE UPDATE ON curriculum_gate
BEGIN
  SELECT RAISE(ABORT, 'a gate of a curriculum cannot be changed');
END;

CREATE TRIGGER curriculum_gate_leaves_a_draft BEFORE DELETE ON curriculum_gate
WHEN (SELECT state FROM curriculum WHERE curriculum.curriculum_id = OLD.curriculum_id) <> 'draft'
BEGIN
  SELECT RAISE(ABORT, 'a published curriculum is not changed: make another');
END;

CREATE TRIGGER curriculum_goes_forward BEFORE UPDATE OF state ON curriculum
WHEN (OLD.state = 'published' AND NEW.state = 'draft') OR (OLD.state = 'retired' AND NEW.state <> 'retired')
BEGIN
  SELECT RAISE(ABORT, 'a published curriculum is not changed: make another');
END;

CREATE TRIGGER curriculum_item_comes_to_a_draft BEFORE INSERT ON curriculum_item
WHEN (SELECT state FROM curriculum WHERE curriculum.curriculum_id = NEW.curriculum_id) <> 'draft'
BEGIN
  SELECT RAISE(ABORT, 'a published curriculum is not changed: make another');
END;

CREATE TRIGGER curriculum_item_is_immutable BEFORE UPDATE ON curriculum_item
BEGIN
  SELECT RAISE(ABORT, 'an item of a curriculum cannot be changed');
END;

CREATE TRIGGER curriculum_item_leaves_a_draft BEFORE DELETE ON curriculum_item
WHEN (SELECT state FROM curriculum WHERE curriculum.curriculum_id = OLD.curriculum_id) <> 'draft'
BEGIN
  SELECT RAISE(ABORT, 'a published curriculum is not changed: make another');
END;

CREATE TRIGGER curriculum_published_is_kept BEFORE DELETE ON curriculum WHEN OLD.state <> 'draft'
BEGIN
  SELECT RAISE(ABORT, 'a published curriculum is retired, not deleted');
END;

CREATE TRIGGER curriculum_published_keeps_its_title BEFORE UPDATE OF title ON curriculum WHEN OLD.state <> 'draft'
BEGIN
  SELECT RAISE(ABORT, 'a published curriculum is not changed: make another');
END;

CREATE TRIGGER cut_is_immutable BEFORE UPDATE ON cut
WHEN OLD.frozen_us IS NOT NULL OR NEW.frozen_us IS NULL OR NEW.cut_id <> OLD.cut_id OR NEW.case_id <> OLD.case_id
  OR NEW.metric_id IS NOT OLD.metric_id OR NEW.version IS NOT OLD.version
  OR NEW.higher_is_better <> OLD.higher_is_better OR NEW.method <> OLD.method OR NEW.options <> OLD.options
  OR NEW.data <> OLD.data OR NEW.value <> OLD.value OR NEW.low IS NOT OLD.low OR NEW.high IS NOT OLD.high
  OR NEW.n <> OLD.n OR NEW.words <> OLD.words OR NEW.proposed_by <> OLD.proposed_by
  OR NEW.proposed_us <> OLD.proposed_us
BEGIN
  SELECT RAISE(ABORT, 'a cut is not changed: propose another');
END;

CREATE TRIGGER cut_is_kept BEFORE DELETE ON cut
WHEN OLD.case_id NOT IN (SELECT id FROM erasing)
  AND EXISTS (SELECT 1 FROM training_case WHERE training_case.case_id = OLD.case_id)
BEGIN
  SELECT RAISE(ABORT, 'a cut cannot be deleted');
END;

CREATE TRIGGER desk_response_goes_with_its_answers BEFORE DELETE ON desk_response
WHEN OLD.person_id IN (SELECT id FROM erasing)
BEGIN
  DELETE FROM response WHERE response_id = OLD.response_id;
  DELETE FROM response_set WHERE response_id = OLD.response_id;
END;

CREATE TRIGGER desk_response_is_immutable BEFORE UPDATE ON desk_response
BEGIN
  SELECT RAISE(ABORT, 'whose answers these are is not changed');
END;

CREATE TRIGGER desk_response_is_kept BEFORE DELETE ON desk_response
WHEN OLD.person_id NOT IN (SELECT id FROM erasing)
BEGIN
  SELECT RAISE(ABORT, 'answers cannot be deleted');
END;

CREATE TRIGGER erased_attempt_is_immutable BEFORE UPDATE ON erased_attempt
BEGIN
  SELECT RAISE(ABORT, 'an erasure cannot be changed');
END;

CREATE TRIGGER erased_attempt_is_kept BEFORE DELETE ON erased_attempt
BEGIN
  SELECT RAISE(ABORT, 'an erasure cannot be taken back');
END;

CREATE TRIGGER erasure_is_immutable BEFORE UPDATE ON erasure
BEGIN
  SELECT RAISE(ABORT, 'an erasure cannot be changed');
END;

CREATE TRIGGER erasure_is_kept BEFORE DELETE ON erasure
BEGIN
  SELECT RAISE(ABORT, 'an erasure cannot be taken back');
END;

CREATE TRIGGER frozen_plan_is_immutable BEFORE UPDATE ON study_plan WHEN OLD.frozen_us IS NOT NULL
BEGIN
  SELECT RAISE(ABORT, 'a frozen plan cannot be changed');
END;

CREATE TRIGGER frozen_plan_stays BEFORE DELETE ON study_plan WHEN OLD.frozen_us IS NOT NULL
BEGIN
  SELECT RAISE(ABORT, 'a frozen plan cannot be removed');
END;

CREATE TRIGGER lesion_comes_to_a_draft BEFORE INSERT ON lesion
WHEN (SELECT state FROM training_case WHERE training_case.case_id = NEW.case_id) <> 'draft'
BEGIN
  SELECT RAISE(ABORT, 'only a draft is changed: make a new version');
END;

CREATE TRIGGER lesion_is_immutable BEFORE UPDATE ON lesion
BEGIN
  SELECT RAISE(ABORT, 'a lesion cannot be changed');
END;

CREATE TRIGGER lesion_leaves_a_draft BEFORE DELETE ON lesion
WHEN (SELECT state FROM training_case WHERE training_case.case_id = OLD.case_id) <> 'draft'
  AND OLD.case_id NOT IN (SELECT id FROM erasing)
BEGIN
  SELECT RAISE(ABORT, 'only a draft is changed: make a new version');
END;

CREATE TRIGGER metric_value_is_immutable BEFORE UPDATE ON metric_value
BEGIN
  SELECT RAISE(ABORT, 'a score cannot be changed');
END;

CREATE TRIGGER metric_value_is_kept BEFORE DELETE ON metric_value
WHEN OLD.attempt_id NOT IN (SELECT id FROM erasing)
BEGIN
  SELECT RAISE(ABORT, 'a score cannot be deleted');
END;

CREATE TRIGGER person_fact_is_immutable BEFORE UPDATE ON person_fact
BEGIN
  SELECT RAISE(ABORT, 'an answer cannot be changed: give another');
END;

CREATE TRIGGER person_kind_is_immutable BEFORE UPDATE OF kind ON person WHEN NEW.kind <> OLD.kind
BEGIN
  SELECT RAISE(ABORT, 'nobody becomes simulated, or real');
END;

CREATE TRIGGER person_level_is_immutable BEFORE UPDATE ON person_level
BEGIN
  SELECT RAISE(ABORT, 'what somebody was cannot be changed');
END;

CREATE TRIGGER questionnaire_is_immutable BEFORE UPDATE ON questionnaire
BEGIN
  SELECT RAISE(ABORT, 'a questionnaire is not changed: store another version');
END;

CREATE TRIGGER questionnaire_stays BEFORE DELETE ON questionnaire
BEGIN
  SELECT RAISE(ABORT, 'a questionnaire cannot be removed');
END;

CREATE TRIGGER rating_is_immutable BEFORE UPDATE ON rating
BEGIN
  SELECT RAISE(ABORT, 'who rates what is not changed');
END;

CREATE TRIGGER rating_known_is_immutable BEFORE UPDATE ON rating_known
BEGIN
  SELECT RAISE(ABORT, 'a known score is not changed');
END;

CREATE TRIGGER rating_view_goes_with_its_ratings BEFORE DELETE ON rating_view
WHEN OLD.attempt_id IN (SELECT id FROM erasing)
BEGIN
  DELETE FROM response WHERE response_id IN (SELECT response_id FROM rating WHERE view_id = OLD.view_id);
  DELETE FROM response_set WHERE response_id IN (SELECT response_id FROM rating WHERE view_id = OLD.view_id);
  DELETE FROM rating WHERE view_id = OLD.view_id;
  DELETE FROM rating_known WHERE view_id = OLD.view_id;
END;

CREATE TRIGGER rating_view_is_immutable BEFORE UPDATE ON rating_view
BEGIN
  SELECT RAISE(ABORT, 'what raters see is not changed');
END;

CREATE TRIGGER rating_view_is_kept BEFORE DELETE ON rating_view
WHEN OLD.attempt_id NOT IN (SELECT id FROM erasing)
BEGIN
  SELECT RAISE(ABORT, 'a rated replay cannot be deleted');
END;

CREATE TRIGGER recording_chunk_is_immutable BEFORE UPDATE ON recording_chunk
BEGIN
  SELECT RAISE(ABORT, 'a recording cannot be changed');
END;

CREATE TRIGGER recording_chunk_is_kept BEFORE DELETE ON recording_chunk
WHEN OLD.attempt_id NOT IN (SELECT id FROM erasing)
BEGIN
  SELECT RAISE(ABORT, 'a recording cannot be deleted');
END;

CREATE TRIGGER response_set_is_of_the_rounds_version BEFORE INSERT ON response_set
WHEN NOT EXISTS (SELECT 1 FROM questionnaire_round JOIN questionnaire USING (form_id, version)
  WHERE round_id = NEW.round_id AND questionnaire_id = NEW.questionnaire_id)
BEGIN
  SELECT RAISE(ABORT, 'answers are to the version that the round asks');
END;

CREATE TRIGGER response_set_stays_simulated BEFORE UPDATE ON response_set WHEN OLD.simulated = 1 AND NEW.simulated = 0
BEGIN
  SELECT RAISE(ABORT, 'what was simulated stays so');
END;

CREATE TRIGGER response_set_submitted_is_immutable BEFORE UPDATE ON response_set WHEN OLD.submitted_us IS NOT NULL
BEGIN
  SELECT RAISE(ABORT, 'submitted answers cannot be changed');
END;

CREATE TRIGGER response_submitted_is_complete BEFORE INSERT ON response
WHEN (SELECT submitted_us FROM response_set WHERE response_id = NEW.response_id) IS NOT NULL
BEGIN
  SELECT RAISE(ABORT, 'submitted answers cannot be added to');
END;

CREATE TRIGGER response_submitted_is_immutable BEFORE UPDATE ON response
WHEN (SELECT submitted_us FROM response_set WHERE response_id = OLD.response_id) IS NOT NULL
BEGIN
  SELECT RAISE(ABORT, 'submitted answers cannot be changed');
END;

CREATE TRIGGER servo_record_is_immutable BEFORE UPDATE ON servo_record
BEGIN
  SELECT RAISE(ABORT, 'a servo record cannot be changed');
END;

CREATE TRIGGER servo_record_is_kept BEFORE DELETE ON servo_record
WHEN OLD.attempt_id NOT IN (SELECT id FROM erasing)
BEGIN
  SELECT RAISE(ABORT, 'a servo record cannot be deleted');
END;

CREATE TRIGGER simulated_people_have_no_account BEFORE INSERT ON account
WHEN (SELECT kind FROM person WHERE person_id = NEW.person_id) = 'simulated'
BEGIN
  SELECT RAISE(ABORT, 'a simulated person has no account');
END;

CREATE TRIGGER simulated_people_make_simulated_attempts BEFORE INSERT ON attempt
WHEN NEW.operator_name = 'person' AND (SELECT kind FROM person WHERE person_id = NEW.person_id) = 'simulated'
BEGIN
  SELECT RAISE(ABORT, 'what a simulated person does is no attempt of a person');
END;

CREATE TRIGGER simulated_truth_is_immutable BEFORE UPDATE ON simulated_truth
BEGIN
  SELECT RAISE(ABORT, 'what was planted cannot be changed');
END;

CREATE TRIGGER standard_attempt_is_immutable BEFORE UPDATE ON standard_attempt
BEGIN
  SELECT RAISE(ABORT, 'a standard cannot be changed: set another');
END;

CREATE TRIGGER standard_band_is_immutable BEFORE UPDATE ON standard_band
BEGIN
  SELECT RAISE(ABORT, 'a standard cannot be changed: set another');
END;

CREATE TRIGGER standard_band_is_kept BEFORE DELETE ON standard_band
WHEN EXISTS (SELECT 1 FROM standard
  WHERE standard.standard_id = OLD.standard_id AND standard.case_id NOT IN (SELECT id FROM erasing))
BEGIN
  SELECT RAISE(ABORT, 'a standard cannot be changed: set another');
END;

CREATE TRIGGER standard_is_immutable BEFORE UPDATE ON standard
BEGIN
  SELECT RAISE(ABORT, 'a standard cannot be changed: set another');
END;

CREATE TRIGGER standard_is_kept BEFORE DELETE ON standard
WHEN OLD.case_id NOT IN (SELECT id FROM erasing)
  AND EXISTS (SELECT 1 FROM training_case WHERE training_case.case_id = OLD.case_id)
BEGIN
  SELECT RAISE(ABORT, 'a standard cannot be deleted');
END;

CREATE TRIGGER structure_comes_to_a_draft BEFORE INSERT ON structure
WHEN (SELECT state FROM training_case WHERE training_case.case_id = NEW.case_id) <> 'draft'
  OR EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = NEW.case_id)
  OR EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = NEW.case_id)
BEGIN
  SELECT RAISE(ABORT, 'only a draft without attempts is changed: make a new version');
END;

CREATE TRIGGER structure_is_immutable BEFORE UPDATE ON structure
BEGIN
  SELECT RAISE(ABORT, 'a structure cannot be changed');
END;

CREATE TRIGGER structure_leaves_a_draft BEFORE DELETE ON structure
WHEN OLD.case_id NOT IN (SELECT id FROM erasing) AND (
  (SELECT state FROM training_case WHERE training_case.case_id = OLD.case_id) <> 'draft'
  OR EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = OLD.case_id)
  OR EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = OLD.case_id))
BEGIN
  SELECT RAISE(ABORT, 'only a draft without attempts is changed: make a new version');
END;

CREATE TRIGGER study_deviation_is_immutable BEFORE UPDATE ON study_deviation
BEGIN
  SELECT RAISE(ABORT, 'a deviation cannot be changed');
END;

CREATE TRIGGER study_deviation_stays BEFORE DELETE ON study_deviation
BEGIN
  SELECT RAISE(ABORT, 'a deviation cannot be removed');
END;

CREATE TRIGGER study_enrolment_is_immutable BEFORE UPDATE ON study_enrolment
BEGIN
  SELECT RAISE(ABORT, 'an allocation cannot be changed');
END;

CREATE TRIGGER study_lock_is_immutable BEFORE UPDATE ON study_lock
BEGIN
  SELECT RAISE(ABORT, 'a lock cannot be changed');
END;

CREATE TRIGGER study_lock_stays BEFORE DELETE ON study_lock
BEGIN
  SELECT RAISE(ABORT, 'a lock cannot be removed');
END;

CREATE TRIGGER study_look_is_immutable BEFORE UPDATE ON study_look
BEGIN
  SELECT RAISE(ABORT, 'a look cannot be changed');
END;

CREATE TRIGGER study_look_stays BEFORE DELETE ON study_look
BEGIN
  SELECT RAISE(ABORT, 'a look cannot be removed');
END;

CREATE TRIGGER training_case_goes_forward BEFORE UPDATE OF state ON training_case
WHEN (OLD.state = 'published' AND NEW.state NOT IN ('published', 'retired'))
  OR (OLD.state = 'retired' AND NEW.state <> 'retired')
BEGIN
  SELECT RAISE(ABORT, 'a published case is not changed: make a new version');
END;

CREATE TRIGGER training_case_keeps_its_burned_in_check BEFORE UPDATE OF burned_in_checked_us ON training_case
WHEN OLD.burned_in_checked_us IS NOT NULL
BEGIN
  SELECT RAISE(ABORT, 'a confirmation cannot be changed');
END;

CREATE TRIGGER training_case_keeps_its_classes BEFORE UPDATE OF classes_sha256 ON training_case
BEGIN
  SELECT RAISE(ABORT, 'the tissue classes of a case cannot be changed');
END;

CREATE TRIGGER training_case_keeps_its_data
BEFORE UPDATE OF case_id, origin, created_us, size_x_voxels, size_y_voxels, size_z_voxels, spacing_x_mm, spacing_y_mm,
  spacing_z_mm, lps_from_voxel_00, lps_from_voxel_01, lps_from_voxel_02, lps_from_voxel_03, lps_from_voxel_10,
  lps_from_voxel_11, lps_from_voxel_12, lps_from_voxel_13, lps_from_voxel_20, lps_from_voxel_21, lps_from_voxel_22,
  lps_from_voxel_23, hu_min, hu_max, slices_used, volume_sha256, skin_sha256, labels_sha256
ON training_case
BEGIN
  SELECT RAISE(ABORT, 'the data of a case cannot be changed');
END;

CREATE TRIGGER training_case_keeps_its_face_state BEFORE UPDATE OF face_state ON training_case
BEGIN
  SELECT RAISE(ABORT, 'the face state of a case cannot be changed');
END;

CREATE TRIGGER training_case_keeps_its_motion
BEFORE UPDATE OF breath_depth, breath_period_s, breath_irregularity, tissue_yields, breath_law, ct_breath ON training_case
WHEN OLD.state <> 'draft' OR EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = OLD.case_id)
  OR EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = OLD.case_id)
BEGIN
  SELECT RAISE(ABORT, 'only a draft without attempts is changed: make a new version');
END;

CREATE TRIGGER training_case_keeps_its_place BEFORE UPDATE OF family_id, version ON training_case
BEGIN
  SELECT RAISE(ABORT, 'the version of a case cannot be changed');
END;

CREATE TRIGGER training_case_keeps_its_probe BEFORE UPDATE OF probe_is_chosen ON training_case
WHEN OLD.state <> 'draft' OR EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = OLD.case_id)
  OR EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = OLD.case_id)
BEGIN
  SELECT RAISE(ABORT, 'only a draft without attempts is changed: make a new version');
END;

CREATE TRIGGER training_case_keeps_its_setting
BEFORE UPDATE OF modality, patient_position, further_modalities, approach, instrument_kind, instrument_length_mm,
  instrument_radius_mm, instrument_inner_radius_mm, instrument_hu, instrument_throw_mm, instrument_notch_mm,
  instrument_dead_tip_mm, inr, platelets_per_nl, allergy, indication, decision, planned_entry_x_lps_mm,
  planned_entry_y_lps_mm, planned_entry_z_lps_mm, difficulty, time_limit_s, attempt_limit, pass_rule
ON training_case
WHEN OLD.state <> 'draft' OR EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = OLD.case_id)
  OR EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = OLD.case_id)
BEGIN
  SELECT RAISE(ABORT, 'only a draft without attempts is changed: make a new version');
END;

CREATE TRIGGER training_case_keeps_its_sight_law
BEFORE UPDATE OF sight_law ON training_case
WHEN OLD.state <> 'draft' OR EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = OLD.case_id)
  OR EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = OLD.case_id)
BEGIN
  SELECT RAISE(ABORT, 'only a draft without attempts is changed: make a new version');
END;

CREATE TRIGGER training_case_keeps_its_subject BEFORE UPDATE OF subject ON training_case
WHEN OLD.state <> 'draft' OR EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = OLD.case_id)
  OR EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = OLD.case_id)
BEGIN
  SELECT RAISE(ABORT, 'only a draft without attempts is changed: make a new version');
END;

CREATE TRIGGER training_case_keeps_its_touch
BEFORE UPDATE OF instrument_tip, touch_law ON training_case
WHEN OLD.state <> 'draft' OR EXISTS (SELECT 1 FROM attempt WHERE attempt.case_id = OLD.case_id)
  OR EXISTS (SELECT 1 FROM open_attempt WHERE open_attempt.case_id = OLD.case_id)
BEGIN
  SELECT RAISE(ABORT, 'only a draft without attempts is changed: make a new version');
END;

CREATE TRIGGER training_case_published_is_kept BEFORE DELETE ON training_case WHEN OLD.state = 'published'
BEGIN
  SELECT RAISE(ABORT, 'a published case is retired, not deleted');
END;

CREATE TRIGGER training_case_published_keeps_its_name BEFORE UPDATE OF title, audience ON training_case
WHEN OLD.state IN ('published', 'retired') AND (OLD.title <> NEW.title OR OLD.audience <> NEW.audience)
BEGIN
  SELECT RAISE(ABORT, 'a published case is not changed: make a new version');
END;

CREATE TRIGGER truth_is_of_simulated_people BEFORE INSERT ON simulated_truth
WHEN (SELECT kind FROM person WHERE person_id = NEW.person_id) <> 'simulated'
BEGIN
  SELECT RAISE(ABORT, 'nobody knows the ability of a real person');
END;

CREATE TRIGGER workshop_participant_is_immutable BEFORE UPDATE ON workshop_participant
BEGIN
  SELECT RAISE(ABORT, 'who came is not changed');
END;
