// What a report says of cases whose difficulty and discrimination were planted.
#include "reports/learning/case_report.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "casedb/grading/dependability.h"
#include "tests/reports/learning/planted_attempts.h"

namespace seldinger::reports {
namespace {

using fixtures::PlantedCase;
using ::testing::HasSubstr;
using ::testing::Not;

const std::vector<PlantedCase> kCases = {{"hard", 1.5}, {"middle", 0.0}, {"easy", -1.5}, {"chance", 0.0, false}};

CaseReport report_of(const std::vector<casedb::LearningAttempt>& attempts,
                     casedb::Learners whose = casedb::Learners::people) {
  CaseReport report;
  report.whose = whose;
  report.program_version = "1";
  for (const PlantedCase& one : kCases) {
    ReportedCase& made = report.cases.emplace_back();
    made.family_id = one.family;
    made.title = "Case <" + one.family + ">";
    for (const auto& attempt : attempts)
      if (attempt.family_id == one.family) made.attempts.push_back(attempt);
  }
  report.dependability = casedb::dependability(attempts);
  return report;
}

// Of a person drawn at random, by the average over abilities.
double true_share(const PlantedCase& at, double ability_sd) {
  base::Rng rng(99);
  double sum = 0.0;
  constexpr int kDraws = 20'000;
  for (int i = 0; i < kDraws; ++i) sum += fixtures::planted_share(ability_sd * rng.normal(), at);
  return sum / kDraws;
}

TEST(CaseReport, FindsThePlantedDifficultyAndDiscrimination) {
  constexpr int kSets = 60;
  int covered = 0, told_apart = 0, chance_not = 0;
  std::vector<double> truth;
  for (const PlantedCase& one : kCases) truth.push_back(true_share(one, 1.5));
  for (int set = 0; set < kSets; ++set) {
    const auto numbers = case_numbers(
        report_of(fixtures::planted_attempts(kCases, 40, 6, 1.5, static_cast<std::uint64_t>(set))).cases);
    for (std::size_t i = 0; i < kCases.size(); ++i)
      covered += numbers[i].first.low <= truth[i] && truth[i] <= numbers[i].first.high ? 1 : 0;
    told_apart += numbers[1].discrimination.ci95->low > 0.0 ? 1 : 0;
    chance_not += numbers[3].discrimination.ci95->low > 0.0 ? 1 : 0;
  }
  // 95 %, less three standard errors of 240.
  EXPECT_GE(covered, static_cast<int>(kSets * 4 * (0.95 - 3.0 * std::sqrt(0.95 * 0.05 / (kSets * 4)))));
  EXPECT_GE(told_apart, kSets - 2);
  EXPECT_LE(chance_not, 6) << "2.5 % of sixty, and three standard errors";
}

TEST(CaseReport, SaysWhatToChange) {
  const auto advice = [](std::size_t first, std::size_t last, std::size_t persons,
                         std::optional<assessment::statistics::Interval> apart) {
    CaseNumbers one;
    one.persons = persons;
    one.first_passes = first;
    one.last_passes = last;
    one.first = {first == persons ? 0.91 : 0.3, 1.0};
    one.last = {0.0, last == 0 ? 0.09 : 0.8};
    one.discrimination.ci95 = apart;
    return advice_text(one);
  };
  using assessment::statistics::Interval;
  EXPECT_THAT(advice(40, 40, 40, Interval{0.1, 0.5}), HasSubstr("nearly everybody"));
  EXPECT_THAT(advice(0, 0, 40, Interval{0.1, 0.5}), HasSubstr("hardly anybody"));
  EXPECT_THAT(advice(10, 20, 40, Interval{-0.3, 0.1}), HasSubstr("does not separate persons"));
  EXPECT_EQ(advice(10, 20, 40, Interval{0.1, 0.5}), "Keep");
  EXPECT_THAT(advice(10, 20, 40, Interval{-0.1, 0.5}), HasSubstr("open"));
  EXPECT_THAT(advice(1, 2, 4, Interval{0.1, 0.5}), HasSubstr("Too few"));
}

TEST(CaseReport, TellsNothingOfFourPeopleButAllOfFourSimulatedOnes) {
  const auto attempts = fixtures::planted_attempts(kCases, 4, 3, 1.5, 1);
  const std::string people = case_report_page(report_of(attempts));
  EXPECT_THAT(people, Not(HasSubstr(" of 4<")));
  EXPECT_THAT(people, HasSubstr("it comes from fewer than five people"));
  EXPECT_THAT(people, Not(HasSubstr("SIMULATED")));
  const std::string simulated = case_report_page(report_of(attempts, casedb::Learners::simulated));
  EXPECT_THAT(simulated, HasSubstr(" of 4<"));
  EXPECT_THAT(simulated, HasSubstr("SIMULATED"));
  EXPECT_THAT(simulated, HasSubstr("Case &lt;hard&gt;"));
}

TEST(CaseReport, HoldsPassesAgainstWhatWasPlanted) {
  CaseReport report;
  report.whose = casedb::Learners::simulated;
  for (const char* family : {"one", "two"}) {
    ReportedCase& made = report.cases.emplace_back();
    made.family_id = family;
    for (int person = 0; person < 6; ++person)
      for (int i = 0; i < 6; ++i)
        made.attempts.push_back(fixtures::planted_attempt("p" + std::to_string(person), family, i < person, i));
  }
  for (int person = 0; person < 6; ++person) report.planted["p" + std::to_string(person)] = 0.3 * person;
  EXPECT_NEAR(against_planted(report).estimate.value(), 1.0, 1e-12);
  EXPECT_THAT(case_report_page(report), HasSubstr("Spearman’s ρ of 1.00"));
  report.planted["p5"] = -1.0;  // the last becomes the first: 1 − 6 (25 + 5) / (6 · 35)
  EXPECT_NEAR(against_planted(report).estimate.value(), 1.0 / 7.0, 1e-12);
}

TEST(CaseReport, OfNothingIsAPage) {
  EXPECT_THAT(case_report_page({}), HasSubstr("There is no attempt yet"));
}

}  // namespace
}  // namespace seldinger::reports
