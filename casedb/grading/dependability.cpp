#include "casedb/grading/dependability.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "assessment/statistics/reliability/g_theory.h"
#include "casedb/database/sqlite.h"

namespace seldinger::casedb {
namespace {

constexpr std::size_t kMostOccasions = 2;

// Of each case and person the graded attempts, oldest first: whether they passed.
using Passes = std::map<std::string, std::map<std::string, std::vector<bool>>>;

Passes passes_of(std::span<const LearningAttempt> attempts) {
  Passes found;
  for (const LearningAttempt& one : attempts)
    if (one.graded()) found[one.family_id][one.person_id].push_back(one.passed());
  return found;
}

struct FullTable {
  std::vector<std::string> cases;
  std::set<std::string> persons;
  std::size_t occasions = 1;
  bool whole() const noexcept { return cases.size() > 1 && persons.size() > 1; }
  std::size_t cells() const noexcept { return whole() ? cases.size() * persons.size() * occasions : 0; }
};

std::set<std::string> persons_at(const Passes& passes, const std::string& family, std::size_t occasions) {
  std::set<std::string> persons;
  for (const auto& [person, passed] : passes.at(family))
    if (passed.size() >= occasions) persons.insert(person);
  return persons;
}

// Cases that most persons attempted come first; each further one keeps those who attempted it, too.
FullTable best_of(const Passes& passes, std::size_t occasions) {
  std::vector<std::pair<std::string, std::set<std::string>>> cases;
  for (const auto& one : passes) cases.emplace_back(one.first, persons_at(passes, one.first, occasions));
  std::stable_sort(cases.begin(), cases.end(),
                   [](const auto& a, const auto& b) { return a.second.size() > b.second.size(); });
  FullTable best, now{{}, {}, occasions};
  for (const auto& one_case : cases) {
    const std::set<std::string>& persons = one_case.second;
    if (now.cases.empty())
      now.persons = persons;
    else
      std::erase_if(now.persons, [&](const std::string& one) { return !persons.contains(one); });
    now.cases.push_back(one_case.first);
    if (now.cells() >= best.cells()) best = now;
  }
  return best;
}

}  // namespace

assessment::statistics::DataTable dependability_table(std::span<const LearningAttempt> attempts) {
  const Passes passes = passes_of(attempts);
  FullTable chosen;
  for (std::size_t occasions = 1; occasions <= kMostOccasions; ++occasions)
    if (FullTable one = best_of(passes, occasions); one.cells() >= chosen.cells()) chosen = std::move(one);
  assessment::statistics::DataTable table;
  table.values.push_back({"passed", {}});
  for (const auto& [family, persons] : passes)
    for (const auto& [person, passed] : persons) {
      const bool wanted = !chosen.whole() || (chosen.persons.contains(person) &&
                                              std::count(chosen.cases.begin(), chosen.cases.end(), family) > 0);
      if (!wanted) continue;
      const std::size_t occasions = chosen.whole() ? chosen.occasions : 1;
      for (std::size_t i = 0; i < occasions; ++i) {
        table.values.front().values.push_back(passed[passed.size() - occasions + i] ? 1.0 : 0.0);
        table.subject.push_back(person);
        table.rater.push_back(family);
        if (occasions > 1) table.x.push_back(static_cast<double>(i + 1));
        ++table.rows;
      }
    }
  return table;
}

assessment::statistics::Answer dependability(std::span<const LearningAttempt> attempts) {
  return assessment::statistics::g_theory(dependability_table(attempts), kDependable);
}

const assessment::statistics::Answer& KeptDependability::of(Library& library) {
  const LearningMark mark = learning_mark(library);
  const std::string now = mark.act + " " + mark.attempts;
  const Clock::time_point begun = Clock::now();
  if (answer_ && (now == of_what_ || begun < until_)) return *answer_;
  answer_ = dependability(learning_verdicts(library, Learners::people));
  of_what_ = now;
  const Clock::time_point done = Clock::now();
  until_ = done + 100 * (done - begun);
  return *answer_;
}

}  // namespace seldinger::casedb
