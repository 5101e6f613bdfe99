#include "session/attempt/rehearsal.h"

#include <algorithm>
#include <numeric>

#include "casedb/cases/case_checks.h"
#include "session/attempt/simulation.h"

namespace seldinger::session {
namespace {

void count_missed(const assessment::Grade& grade, std::vector<MissedCriterion>& all) {
  for (const assessment::CriterionResult& one : grade.criteria) {
    if (one.outcome == assessment::Outcome::met) continue;
    const auto known = std::find_if(all.begin(), all.end(), [&](const MissedCriterion& other) {
      return other.of.of_the_time_limit == one.of_the_time_limit &&
             assessment::text_of(other.of.criterion) == assessment::text_of(one.criterion);
    });
    ++(known != all.end() ? *known : all.emplace_back(MissedCriterion{one, 0})).missed;
  }
}

}  // namespace

std::size_t Rehearsal::attempts() const noexcept {
  return std::accumulate(levels.begin(), levels.end(), std::size_t{0},
                         [](std::size_t sum, const RehearsedLevel& one) { return sum + one.attempts; });
}

std::size_t Rehearsal::passed() const noexcept {
  return std::accumulate(levels.begin(), levels.end(), std::size_t{0},
                         [](std::size_t sum, const RehearsedLevel& one) { return sum + one.passed; });
}

base::Result<Rehearsal> rehearse(casedb::Library& library, const std::string& case_id, const RehearsalWish& wish) {
  Rehearsal found;
  found.content_mark = casedb::content_mark(library, case_id);
  found.people = wish.people;
  found.seed = wish.seed;
  const auto row = casedb::find_case(library, case_id);
  if (!row) return row.error();
  if (row->rule.criteria.empty())
    return base::Error{"no_rule", "the case has no pass rule: there is nothing to be met"};
  const auto simulation = Simulation::prepare(library, Program{}, case_id, "");
  if (!simulation) return simulation.error();
  // In turn a person of every level: what is known when it is stopped is known of all of them.
  std::vector<SimulatedTrial> trials;
  for (const std::string_view name : kRehearsedLevels) {
    const auto profile = assessment::named_profile(std::string(name));
    found.levels.push_back({std::string(name)});
    const auto own = simulated_trials(*profile, wish.seed, 1, wish.people);
    trials.insert(trials.end(), own.begin(), own.end());
  }
  const std::size_t levels = found.levels.size();
  std::vector<SimulatedTrial> in_turn;
  for (std::size_t i = 0; i < trials.size(); ++i)
    in_turn.push_back(trials[(i % levels) * wish.people + i / levels]);
  if (wish.told && !wish.told(0, in_turn.size())) return found;
  const auto done =
      simulation->forgotten_attempts(in_turn, wish.jobs, [&](std::size_t i, const assessment::Grade& grade) {
        RehearsedLevel& level = found.levels[i % levels];
        ++level.attempts;
        level.passed += grade.verdict == assessment::Verdict::passed ? 1 : 0;
        count_missed(grade, found.missed);
        return !wish.told || wish.told(i + 1, in_turn.size());
      });
  if (!done) return done.error();
  std::stable_sort(found.missed.begin(), found.missed.end(),
                   [](const MissedCriterion& a, const MissedCriterion& b) { return a.missed > b.missed; });
  return found;
}

}  // namespace seldinger::session
