// The report of a learner whose course is known.
#include "reports/learning/learner_report.h"

#include <gmock/gmock.h>

#include "assessment/registry.h"
#include "tests/reports/learning/planted_attempts.h"

namespace seldinger::reports {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

LearnerItem item_of(const std::string& letters) {
  LearnerItem item;
  item.title = "Liver & more";
  const assessment::MetricInfo* info = assessment::find_metric("tip_target_dist");
  item.rule.criteria = {{info->id, info->version, assessment::Comparison::at_most, 5.0}};
  for (std::size_t i = 0; i < letters.size(); ++i) {
    item.attempts.push_back(
        fixtures::planted_attempt("p", "f", letters[i] == 'P', static_cast<std::int64_t>(i) * 86'400'000'000));
    if (letters[i] == '-') item.attempts.back().verdict = assessment::Verdict::not_gradable;
    const double t = static_cast<double>(i + 1);
    // Levels off at 3 mm.
    item.attempts.back().metrics.push_back(
        {info->id, info->version, 3.0 + 12.0 * std::exp(-0.5 * t) + 0.05 * std::cos(9.0 * t), info->unit, ""});
  }
  return item;
}

LearnerReport report_of(const std::string& letters) {
  LearnerReport report;
  report.learner = "tina <b>";
  report.program_version = "1";
  report.items.push_back(item_of(letters));
  return report;
}

TEST(LearnerReport, TellsTheCourseWithItsRules) {
  const std::string page = learner_report_page(report_of("FFF-FPFPPPPPPPPPPP"));
  EXPECT_THAT(page, HasSubstr("tina &lt;b&gt;"));
  EXPECT_THAT(page, HasSubstr("Liver &amp; more"));
  EXPECT_THAT(page, HasSubstr("12 of 17 graded attempts passed; 1 more are not graded"));
  EXPECT_THAT(page, HasSubstr("10 of the last 10 passed"));
  EXPECT_THAT(page, HasSubstr("Levels off at 3 mm (95 % interval 2.9"));
  EXPECT_THAT(page, HasSubstr("LC-CUSUM"));
  EXPECT_EQ(page, learner_report_page(report_of("FFF-FPFPPPPPPPPPPP"))) << "the same report, the same bytes";
}

TEST(LearnerReport, SaysWhyThereIsNoNumber) {
  const std::string page = learner_report_page(report_of("-"));
  EXPECT_THAT(page, HasSubstr("Not estimated: there is no value"));
  EXPECT_THAT(page, Not(HasSubstr("nan")));
  EXPECT_THAT(learner_report_page({}), HasSubstr("There is no attempt yet"));
}

// What is drawn stays within the drawing, whatever the values.
TEST(LearnerReport, HasNoNumberThatIsNone) {
  LearnerReport report = report_of("FPPF");
  report.items.front().attempts[1].metrics.front().value = std::nan("");
  report.items.front().attempts[2].metrics.front().value = 1e300;
  const std::string page = learner_report_page(report);
  for (const char* bad : {">nan", "\"nan", "-nan", "inf\"", ">inf"}) EXPECT_THAT(page, Not(HasSubstr(bad)));
}

}  // namespace
}  // namespace seldinger::reports
