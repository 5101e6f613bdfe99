#include "app/population/open_surrogate.h"

#include <cmath>

#include "app/cli/command.h"
#include "app/cli/file.h"
#include "app/cli/progress.h"
#include "app/cli/words.h"
#include "casedb/cases/case_checks.h"
#include "session/attempt/simulated_people.h"
#include "sim/base/check.h"
#include "sim/engine/step.h"

namespace seldinger::app {

namespace population = assessment::population;

population::SurrogateMark mark_of_case(casedb::Library& library, const session::Simulation& simulation) {
  const casedb::CaseRow& row = simulation.task().row;
  return population::mark_of_today(engine::kStepVersion, row.case_id, row.title,
                                   casedb::content_mark(library, row.case_id), row.sight_law);
}

base::Result<population::Surrogate> surrogate_of(const Arguments& arguments) {
  return surrogate_in("--surrogate", arguments.required("--surrogate"));
}

base::Result<population::Surrogate> surrogate_in(const char* option, const std::string& file) {
  const auto text = read_text(file);
  if (!text) return error_of(option, file, text.error());
  auto surrogate = population::Surrogate::from_json(*text);
  if (!surrogate) return error_of(option, file, surrogate.error());
  const population::SurrogateMark& mark = surrogate->mark();
  // Of which law of sight its case is the file does not say: one of them must have measured these versions.
  std::string differs;
  for (const auto& law : cases::kSightLawNames) {
    differs = difference(mark, population::mark_of_today(engine::kStepVersion, mark.case_id, mark.case_title,
                                                         mark.case_mark, law.value));
    if (differs.empty()) return surrogate;
  }
  return base::Error{"other_surrogate", "the surrogate is of " + differs, {}};
}

std::optional<population::Group> group_from(const std::string& text) {
  if (const auto named = population::named_group(text)) return named;
  const double shift = parse_number(text).value_or(NAN);
  if (!(std::abs(shift) <= kMostShift)) return std::nullopt;
  return population::shifted_group(shift);
}

Numbered numbered(const Shard& shard, std::size_t people) noexcept {
  const std::size_t before = people * (shard.number - 1) / shard.of;
  return {before + 1, people * shard.number / shard.of - before};
}

base::Result<std::vector<population::SimulatedPoint>> simulated_points(const session::Simulation& simulation,
                                                                       const std::vector<population::Group>& groups,
                                                                       std::uint64_t seed, Numbered people,
                                                                       std::size_t jobs) {
  const std::uint64_t case_key = population::case_key_of(simulation.task().row.title);
  std::vector<session::SimulatedTrial> trials;
  std::vector<population::SimulatedPoint> points;
  for (std::size_t number = people.first; number < people.first + people.count; ++number) {
    const auto person = population::drawn_person(groups[(number - 1) % groups.size()], seed, number);
    const population::Occasion occasion{case_key, 0, 0.0};
    session::SimulatedTrial& trial = trials.emplace_back();
    trial.profile = population::profile_on(person, occasion);
    trial.seed = population::attempt_seed(person, occasion);
    trial.mishaps = population::mishaps_on(person, occasion);
    trial.mishaps->device_lost_s.reset();  // at random and of no ability: studies plant it themselves
    points.emplace_back().place = population::place_of(person, occasion);
  }
  Progress progress(trials.size());
  const auto done = simulation.measured_attempts(
      trials, jobs, [&](std::size_t i, const session::Simulation::MeasuredAttempt& attempt) {
        for (const assessment::MetricValue& one : attempt.metrics) points[i].values.push_back(one.value);
        progress.one_done();
        return true;
      });
  progress.clear();
  if (!done) return done.error();
  return points;
}

}  // namespace seldinger::app
