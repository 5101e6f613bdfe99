// Attempts of simulated operators at a stored case: run, score, picture, store.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assessment/metrics/metric.h"
#include "assessment/operators/profile.h"
#include "assessment/operators/scripted.h"
#include "assessment/population/person.h"
#include "casedb/attempts/attempts.h"
#include "casedb/cases/cases.h"
#include "casedb/grading/grading.h"
#include "session/attempt/interrupted_attempt.h"
#include "session/attempt/live_attempt.h"
#include "session/case/program.h"
#include "session/case/task.h"

namespace seldinger::session {

// One of the attempts to be made: by whom, as he is then.
struct SimulatedTrial {
  assessment::OperatorProfile profile{};
  std::uint64_t seed = 0;                 // as the attempt keeps it
  std::optional<std::uint64_t> stream{};  // that hands and eyes draw from; none: the seed, which is a stream itself
  std::optional<std::uint64_t> person{};  // number among people drawn about a profile, from 1
  std::uint64_t number = 0;               // of the attempt, from 0
  // Of a simulated person (simulated_people.h): who, when, and what keeps the attempt from being whole.
  std::optional<std::string> person_id{};
  std::optional<std::int64_t> started_us{};
  std::optional<assessment::population::Mishaps> mishaps{};
  std::optional<std::string> station{};  // where that is to count
};

// `count` attempts of the profile itself, attempt i with seed + i and the operator's stream of it
// (stream_of_operator); or of each of `people`, drawn about the profile by seed, profile and number, so that the
// same seed is the same people at every case, and no two share a stream.
std::vector<SimulatedTrial> simulated_trials(const assessment::OperatorProfile& profile, std::uint64_t seed,
                                             std::size_t count, std::optional<std::size_t> people);

// One that was made and stored.
struct SimulatedAttempt {
  std::string attempt_id, operator_name;
  std::uint64_t seed = 0;
  std::vector<assessment::MetricValue> metrics;
  std::optional<std::uint64_t> person{};  // as its trial's
  std::uint64_t number = 0;               // likewise
  std::optional<casedb::AttemptGrade> grade{};
};

class Simulation {
 public:
  // As prepare_task. `library` must outlive it.
  static base::Result<Simulation> prepare(casedb::Library& library, Program program, const std::string& case_id,
                                          const std::string& lesion_id,
                                          std::optional<cases::InstrumentKind> kind = std::nullopt,
                                          std::optional<cases::Modality> modality = std::nullopt);

  // What a mentor lets happen in each of the attempts, by rising time. Refused: `no_patient` of a phantom,
  // `no_injection` of contrast through a core needle.
  base::Result<void> set_scenario(std::vector<cases::Event> events);

  // One attempt, stored and durable when it returns. `person_id`: whose attempt it is.
  base::Result<SimulatedAttempt> attempt(const assessment::OperatorProfile& profile, std::uint64_t seed,
                                         const std::optional<std::string>& person_id);

  // The attempt in the middle of those of several seeds (median_attempt.h), stored as `attempt` stores it; the
  // others are not kept.
  base::Result<SimulatedAttempt> median_attempt(const assessment::OperatorProfile& profile,
                                                std::span<const std::uint64_t> seeds, std::size_t jobs,
                                                const std::optional<std::string>& person_id);

  // Many, on so many threads; stored in their order, so that the result is that of one thread. `stored` is told of
  // each. Without pictures none of the moment of firing is made. Of a person's attempt that is there by then
  // nothing is stored, and that one is told.
  base::Result<void> attempts(const std::vector<SimulatedTrial>& trials, std::size_t jobs, bool pictures,
                              const std::function<void(SimulatedAttempt)>& stored);
  // The same, not stored: as measured, or graded by the case's rule as it is. `made` is told of each by its place
  // in `trials`; false: no more of them.
  struct MeasuredAttempt {
    std::vector<assessment::MetricValue> metrics;
    double duration_s = 0.0;
  };
  using Measured = std::function<bool(std::size_t trial, const MeasuredAttempt& attempt)>;
  base::Result<void> measured_attempts(const std::vector<SimulatedTrial>& trials, std::size_t jobs,
                                       const Measured& made) const;
  using Forgotten = std::function<bool(std::size_t trial, const assessment::Grade& grade)>;
  base::Result<void> forgotten_attempts(const std::vector<SimulatedTrial>& trials, std::size_t jobs,
                                        const Forgotten& made) const;

  // In real time, as a person's: the servo's thread moves the hands, chunks are stored while it runs, and how time
  // was kept is stored with it. Refused: `not_in_real_time` under a fluoroscope. `opened` is told the attempt's id
  // once there is one: whoever knows it can go on with it if this program dies.
  using Opened = std::function<void(const std::string& attempt_id)>;
  base::Result<SimulatedAttempt> live_attempt(const assessment::OperatorProfile& profile, std::uint64_t seed,
                                              const Opened& opened = {});

  // Goes on with one of these that was interrupted, by the operator who made it: brought up to date by what was
  // recorded. CHECKs that it is nobody's. Refused: `other_case` (it was made at another case or lesion, or
  // otherwise), as InterruptedAttempt::replay.
  base::Result<SimulatedAttempt> resume(InterruptedAttempt interrupted, const assessment::OperatorProfile& profile);

  const Task& task() const noexcept { return task_; }

 private:
  base::Result<std::string> store_once(const casedb::NewAttempt& made);
  // Changes nothing, so that threads may make many at once.
  base::Result<casedb::NewAttempt> make(const SimulatedTrial& trial, bool picture) const;
  // Made on so many threads, taken in their order; false or an error: no more of them.
  using Taken = std::function<base::Result<bool>(std::size_t trial, casedb::NewAttempt& made)>;
  base::Result<void> each(const std::vector<SimulatedTrial>& trials, std::size_t jobs, bool pictures,
                          const Taken& take) const;
  base::Result<SimulatedAttempt> run_live(LiveAttempt live, assessment::ScriptedOperator& person,
                                          std::uint32_t happened, std::uint64_t seed,
                                          const Opened& opened = {}) const;
  Simulation(casedb::Library& library, Program program, Task task)
      : library_(&library), program_(std::move(program)), task_(std::move(task)) {}

  casedb::Library* library_;
  Program program_;
  Task task_;
  std::vector<cases::Event> scenario_;
};

}  // namespace seldinger::session
