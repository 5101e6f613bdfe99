#include "reports/learning/case_report.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "assessment/statistics/relations/correlation.h"
#include "assessment/statistics/relations/proportions.h"
#include "casedb/database/uuid.h"
#include "casedb/grading/dependability.h"
#include "casedb/people/simulated_people.h"

namespace seldinger::reports {
namespace {

namespace statistics = assessment::statistics;

// Judgement. An easy case is passed by nine in ten at the first attempt, a hopeless one by one in ten after
// practice; a case that goes with the others to less than this tells nobody apart.
constexpr double kEasy = 0.9, kHopeless = 0.1, kTellsApart = 0.2;
constexpr std::size_t kLeastPersons = 5;

struct PersonsPasses {
  std::size_t passed = 0, graded = 0;
  bool first = false, last = false;
  double share() const { return static_cast<double>(passed) / static_cast<double>(graded); }
};

std::map<std::string, PersonsPasses> by_person(const ReportedCase& one) {
  std::map<std::string, PersonsPasses> persons;
  for (const casedb::LearningAttempt& attempt : one.attempts) {
    if (!attempt.graded()) continue;
    PersonsPasses& person = persons[attempt.person_id];
    if (person.graded == 0) person.first = attempt.passed();
    person.last = attempt.passed();
    ++person.graded;
    person.passed += attempt.passed() ? 1U : 0U;
  }
  return persons;
}

}  // namespace

CaseReport case_report_of(casedb::Library& library, casedb::Learners whose, const std::string& program_version) {
  CaseReport report{whose, casedb::now_us(), program_version, {}, {}, {}};
  const std::vector<casedb::LearningAttempt> attempts = casedb::learning_attempts(library, whose);
  report.dependability = casedb::dependability(attempts);
  for (const casedb::CaseRow& row : casedb::list_case_heads(library)) {
    const auto found = std::find_if(report.cases.begin(), report.cases.end(),
                                    [&](const ReportedCase& one) { return one.family_id == row.family_id; });
    ReportedCase& one = found == report.cases.end() ? report.cases.emplace_back() : *found;
    one.family_id = row.family_id;
    one.title = row.title;
    one.rule = row.rule;
  }
  for (const casedb::LearningAttempt& attempt : attempts)
    for (ReportedCase& one : report.cases)
      if (one.family_id == attempt.family_id) one.attempts.push_back(attempt);
  std::erase_if(report.cases, [](const ReportedCase& one) { return one.attempts.empty(); });
  if (whose == casedb::Learners::simulated)
    for (const casedb::SimulatedTruth& one : casedb::list_simulated_truths(library))
      report.planted[one.person_id] =
          std::accumulate(one.ability.begin(), one.ability.end(), 0.0) / static_cast<double>(one.ability.size());
  return report;
}

std::vector<CaseNumbers> case_numbers(const std::vector<ReportedCase>& cases) {
  std::vector<std::map<std::string, PersonsPasses>> all;
  for (const ReportedCase& one : cases) all.push_back(by_person(one));
  std::vector<CaseNumbers> numbers;
  for (std::size_t i = 0; i < all.size(); ++i) {
    CaseNumbers& made = numbers.emplace_back();
    made.persons = all[i].size();
    statistics::DataTable table;
    table.values.push_back({"here", {}});
    for (const auto& [person, here] : all[i]) {
      made.first_passes += here.first ? 1U : 0U;
      made.last_passes += here.last ? 1U : 0U;
      double elsewhere = 0.0;
      std::size_t others = 0;
      for (std::size_t k = 0; k < all.size(); ++k)
        if (const auto found = all[k].find(person); k != i && found != all[k].end()) {
          elsewhere += found->second.share();
          ++others;
        }
      if (others == 0) continue;
      table.values.front().values.push_back(here.share());
      table.x.push_back(elsewhere / static_cast<double>(others));
      ++table.rows;
    }
    if (made.persons > 0) {
      const auto n = static_cast<std::int64_t>(made.persons);
      made.first = statistics::wilson_interval(static_cast<std::int64_t>(made.first_passes), n);
      made.last = statistics::wilson_interval(static_cast<std::int64_t>(made.last_passes), n);
    }
    made.discrimination = statistics::settled(statistics::pearson(table, {}));
  }
  return numbers;
}

statistics::Answer against_planted(const CaseReport& report) {
  std::map<std::string, std::vector<double>> shares;
  for (const ReportedCase& one : report.cases)
    for (const auto& [person, here] : by_person(one)) shares[person].push_back(here.share());
  statistics::DataTable table;
  table.values.push_back({"passed", {}});
  for (const auto& [person, own] : shares) {
    const auto found = report.planted.find(person);
    if (found == report.planted.end()) continue;
    table.values.front().values.push_back(std::accumulate(own.begin(), own.end(), 0.0) /
                                          static_cast<double>(own.size()));
    table.x.push_back(found->second);
    ++table.rows;
  }
  return statistics::settled(statistics::spearman(table, {}));
}

std::string advice_text(const CaseNumbers& numbers) {
  if (numbers.persons < kLeastPersons) return "Too few to say: fewer than five persons";
  if (numbers.first.low >= kEasy) return "Change or retire: nearly everybody passes at the first attempt";
  if (numbers.last.high <= kHopeless) return "Change or retire: hardly anybody passes, even at the last attempt";
  const auto& interval = numbers.discrimination.ci95;
  if (interval && interval->high < kTellsApart)
    return "Change or retire: it does not separate persons as the others do";
  if (!interval) return "Keep for now: nothing is known about how it agrees with other cases";
  return interval->low > 0.0 ? "Keep" : "Keep for now: whether it separates persons is open";
}

}  // namespace seldinger::reports
