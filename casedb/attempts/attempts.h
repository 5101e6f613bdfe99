// Attempts of a library, stored at once or while they run. One function per question, its SQL beside it in sql/.
// Ids are UUIDv7 text, times microseconds since 1970 UTC. Every write is one transaction: it is stored whole and
// acknowledged, or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "assessment/grading/standard.h"
#include "assessment/metrics/metric.h"
#include "assessment/operators/person_operator.h"
#include "assessment/procedure/steps.h"
#include "casedb/attempts/conditions.h"
#include "casedb/database/library.h"
#include "sim/base/result.h"
#include "sim/case/case.h"
#include "sim/case/record/recording.h"
#include "sim/case/record/servo_record.h"

namespace seldinger::casedb {

using MetricValue = assessment::MetricValue;

// The operator_name of what a person did; all others are simulated, also in a person's name.
using assessment::kPersonOperator;

// What is known of an attempt when it begins.
struct AttemptHead {
  std::string case_id, lesion_id;
  std::optional<std::string> person_id;  // whose; none for a simulation of nobody
  std::string operator_name;             // "novice", …, or kPersonOperator
  std::uint64_t seed = 0;                // simulated operators
  std::string program_version;
  cases::Instrument instrument;
  cases::Picture picture;
  cases::Approach approach = cases::Approach::in_plane;
  std::int64_t started_us = 0;
  // For how long it lay interrupted before somebody went on with it; none: it did not, or nobody knows.
  std::optional<double> away_s{};
  bool synthetic() const noexcept { return operator_name != kPersonOperator; }
};

// Interrupted: the program that made it was gone before it could say.
enum class AttemptEnd { fired, stopped, time_limit, device_lost, interrupted };
std::string name_of(AttemptEnd end);

// What is known beside its recording when it has ended.
struct AttemptOutcome {
  std::optional<AttemptEnd> end{};
  std::vector<MetricValue> metrics;
  std::vector<assessment::StepResult> steps{};
  std::vector<std::byte> picture_png;         // the picture at the moment of firing; may be empty
  std::optional<cases::ServoRecord> servo{};  // none: it ran in virtual time
  // What the recording does not say by itself (add_recorded); of simulated operators' nothing is asked for.
  Conditions conditions{};
};

struct NewAttempt : AttemptHead, AttemptOutcome {
  double duration_s = 0.0;
  cases::Recording recording;
};

struct AttemptRow : AttemptHead {
  std::string attempt_id, case_title, picture_sha256;
  cases::Lesion lesion;
  double duration_s = 0.0;
  std::uint32_t step_version = 0;
  std::optional<AttemptEnd> end{};           // none: stored before schema 5
  std::vector<MetricValue> metrics;          // newest version of each
  std::vector<MetricValue> older_metrics{};  // what was stored by older versions
  Conditions conditions{};                   // by find_attempt; lists are without
};

// `no_case`, `no_lesion`, `no_person`, `no_attempts_left` (a person has begun as many as the case allows). Durable
// when it returns.
base::Result<std::string> add_attempt(Library& library, const NewAttempt& attempt);
// Newest first; `count` of them from the one at `first`, which is 0 for the newest.
std::vector<AttemptRow> list_attempts(Library& library, std::size_t first = 0,
                                      std::size_t count = std::numeric_limits<std::size_t>::max());
std::size_t count_attempts(Library& library);
// Of some people, and of nobody where that is wanted; as list_attempts.
struct WhoseAttempts {
  std::vector<std::string> people;  // person ids
  bool nobodys = false;
};
std::vector<AttemptRow> list_attempts(Library& library, const WhoseAttempts& whose, std::size_t first,
                                      std::size_t count);
std::size_t count_attempts(Library& library, const WhoseAttempts& whose);
std::vector<AttemptRow> list_attempts_of(Library& library, const std::string& person_id);  // newest first
// The same without metrics; and with these alone, beside each that has no value for want of an endpoint.
std::vector<AttemptRow> list_bare_attempts_of(Library& library, const std::string& person_id);
std::vector<AttemptRow> list_attempts_of(Library& library, const std::string& person_id,
                                         const std::set<std::string>& metrics);
std::vector<AttemptRow> list_attempts_on(Library& library, const std::string& case_id);  // newest first
// Those on a case whose values may make a band: of people who were consultants when they began, or of the simulated
// expert (of that the newest 200); newest first.
std::vector<AttemptRow> list_expert_attempts(Library& library, const std::string& case_id,
                                             assessment::SetKind kind);
base::Result<AttemptRow> find_attempt(Library& library, const std::string& attempt_id);  // `no_attempt`
base::Result<cases::Recording> load_recording(Library& library, const std::string& attempt_id);
// Its steps, newest version of each, in order; none: stored before schema 8, and not recomputed since.
std::vector<assessment::StepResult> list_steps(Library& library, const std::string& attempt_id);
// Nothing of it is known of attempts from before schema 13.
Conditions find_conditions(Library& library, const std::string& attempt_id);
// What a condition that is a word (condition_table.h) was in a person's attempts, by attempt, where it is known.
std::map<std::string, std::string> condition_words_of(Library& library, const std::string& person_id,
                                                      const std::string& condition_id);
std::optional<cases::ServoRecord> find_servo_record(Library& library, const std::string& attempt_id);
// Those whose version is not there yet: older values are kept. How many; `no_attempt`.
base::Result<std::size_t> add_metrics(Library& library, const std::string& attempt_id,
                                      const std::vector<MetricValue>& metrics);
// The same of its steps; all of a version are added, or none.
base::Result<std::size_t> add_steps(Library& library, const std::string& attempt_id,
                                    const std::vector<assessment::StepResult>& steps);

// An attempt that is stored while it runs. Each chunk is durable when add_chunk returns; a program that dies leaves
// an open attempt behind, for somebody else to close as interrupted.
struct OpenAttempt : AttemptHead {
  std::string attempt_id;
  int chunks = 0;  // stored so far
};
base::Result<std::string> open_attempt(Library& library, const AttemptHead& head);  // refuses as add_attempt
// Refused: `no_attempt`, `incomplete` (its sequence is not the next one).
base::Result<void> add_chunk(Library& library, const std::string& attempt_id, const cases::RecordingChunk& chunk);
base::Result<cases::Recording> load_open_recording(Library& library, const std::string& attempt_id);
// Somebody goes on with one that a program left behind: for how long nobody was at it, since the last piece was
// stored and by the wall's clock, is kept with it as far as that is known. `no_attempt`.
base::Result<void> note_resumption(Library& library, const std::string& attempt_id);
// What is known by now of the conditions under which it is made, beside what is known already; close_attempt keeps
// them. `no_attempt`.
base::Result<void> note_conditions(Library& library, const std::string& attempt_id, const Conditions& conditions);
std::vector<OpenAttempt> list_open_attempts(Library& library);  // oldest first; running ones too
// Makes it an attempt like any other. Refused: `no_attempt`, and as recording_from_chunks.
base::Result<void> close_attempt(Library& library, const std::string& attempt_id, const AttemptOutcome& outcome);

// Somebody watches a stored attempt now. `no_attempt`, `no_person`.
base::Result<void> note_replay_watched(Library& library, const std::string& person_id,
                                       const std::string& attempt_id);
// How often a person has watched attempts at any version of a case so far.
struct ReplaysWatched {
  int others = 0, own = 0;
};
ReplaysWatched count_replays_watched(Library& library, const std::string& person_id, const std::string& case_id);

}  // namespace seldinger::casedb
