// A report's data, redone by the script beside it: on random studies with ties, failures, absent people and missed
// visits, and with a number that was changed.
#include "reports/studies/report_data.h"

#include <gmock/gmock.h>

#include <fstream>

#include "sim/base/rng.h"
#include "tests/assessment/statistics/r_oracle.h"
#include "tests/assessment/study/sample_plan.h"
#include "tests/fixtures/process.h"

namespace seldinger::reports {
namespace {

namespace study = assessment::study;
using ::testing::HasSubstr;
using ::testing::Not;

// One that fired, or that did neither; on a grid of half millimetres, so that there are ties.
study::StudyAttempt drawn_attempt(base::Rng& rng, double middle_mm, double day) {
  const auto now = [](const char* id, std::optional<double> value, const char* reason) {
    const assessment::MetricInfo* info = assessment::find_metric(id);
    return assessment::MetricValue{id, info->version, value, info->unit, reason};
  };
  study::StudyAttempt made;
  made.case_id = "case-1";
  made.day = day;
  made.hand = "arm";
  std::optional<double> distance;
  if (rng.uniform() < 0.9) distance = std::round(2.0 * (middle_mm + 2.0 * rng.normal())) / 2.0;
  made.metrics = {now("procedure_performed", 1.0, ""), now("skin_punctures", 1.0, ""),
                  now("tip_target_dist", distance, distance ? "" : "no_endpoint"),
                  now("nogo_length", std::exp(rng.normal()), "")};
  return made;
}

ValidityReport random_report(std::uint64_t seed, const char* test, std::size_t most) {
  base::Rng rng(seed);
  ValidityReport report;
  report.plan.plan = study::sample_plan();
  report.plan.frozen_us = 1;
  study::Plan& plan = report.plan.plan;
  plan.primary[0].test = *base::from_name(study::kTestNames, test);
  if (plan.primary[0].test == study::Test::welch) plan.primary[0].failure_value = 20.0;
  plan.visits.push_back({"later", 20.0, 30.0});
  plan.absent = rng.uniform() < 0.5 ? study::Absent::left_out : study::Absent::failure;
  plan.secondary = {plan.primary[1]};
  plan.secondary[0].name = "no-go again";
  std::vector<study::StudyPerson> people;
  for (const char* group : {"few", "many"}) {
    const auto n = 5 + static_cast<std::size_t>(rng.uniform() * static_cast<double>(most - 4));
    for (std::size_t i = 0; i < n; ++i) {
      study::StudyPerson& person = people.emplace_back();
      person.name = std::string("P-") + group + std::to_string(i);
      person.group = group;
      const double middle = (person.group == "few" ? 8.0 : 5.0) + rng.normal();
      const double came = rng.uniform();
      for (int k = 0; k < 3 && came > 0.1; ++k) person.attempts.push_back(drawn_attempt(rng, middle, 0.0));
      if (came > 0.25) person.attempts.push_back(drawn_attempt(rng, middle, 25.0));
    }
  }
  report.result = study::analyse(plan, people);
  study::add_sensitivity(plan, people, report.result);
  const assessment::MetricInfo* info = assessment::find_metric("tip_target_dist");
  report.rules["case-1"].criteria = {{info->id, info->version, assessment::Comparison::at_most, 6.0}};
  return report;
}

fixtures::Ran redone(const std::vector<DataFile>& files, const std::string& name) {
  const auto folder = fixtures::fresh_folder("redo_" + name);
  for (const DataFile& one : files) std::ofstream(folder / one.name) << one.content;
  return fixtures::run("Rscript --vanilla '" + (folder / "redo.R").string() + "' '" + folder.string() + "'",
                       folder / "said");
}

TEST(ReportData, IsRedoneByRWithAnyTest) {
  SELDINGER_NEEDS_R();
  for (std::size_t set = 0; set < std::max<std::size_t>(1, fixtures::r_sets() / 20); ++set)
    for (const char* test : {"welch", "brunner_munzel", "mann_whitney"})
      for (const std::size_t most : {7U, 40U}) {
        const std::string name = std::string(test) + "_" + std::to_string(most);
        SCOPED_TRACE(name + " " + std::to_string(set));
        const auto ran = redone(report_data(random_report(fixtures::r_seed() + set, test, most)), name);
        EXPECT_EQ(ran.exit_code, 0) << ran.out << ran.err;
        EXPECT_THAT(ran.out, HasSubstr(" numbers redone, 0 differ"));
      }
}

// The script can fail: it finds one number in a hundred that is off by a thousandth.
TEST(ReportData, ANumberThatIsOffIsTold) {
  SELDINGER_NEEDS_R();
  auto files = report_data(random_report(1, "welch", 20));
  std::string& numbers = files[2].content;
  const std::size_t at = numbers.find("1,plan,estimate,") + 16;
  const std::size_t end = numbers.find('\n', at);
  numbers.replace(at, end - at, std::to_string(std::stod(numbers.substr(at, end - at)) + 0.001));
  const auto ran = redone(files, "off");
  EXPECT_EQ(ran.exit_code, 1) << ran.out << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("differs: outcome 1 plan estimate"));
  EXPECT_THAT(ran.out, HasSubstr(" 1 differ"));
}

TEST(ReportData, NamesNobody) {
  for (const DataFile& one : report_data(random_report(2, "brunner_munzel", 10)))
    EXPECT_THAT(one.content, Not(HasSubstr("P-"))) << one.name;
}

}  // namespace
}  // namespace seldinger::reports
