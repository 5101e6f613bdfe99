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

// Two passes in a row take two attempts; what one alone would show of them is nothing.
TEST(LearnerReport, TellsHowWeakTwoRunningAreFromTwoAttemptsOn) {
  EXPECT_THAT(learner_report_page(report_of("P")), Not(HasSubstr("attempts with a probability of")));
  EXPECT_THAT(learner_report_page(report_of("PF")), HasSubstr("within 2 attempts with a probability of 0.25"));
}

// The axis has the unit of the limit beside it, and a count no fraction.
TEST(LearnerReport, ChartsHaveTheUnitsOfTheirLimits) {
  LearnerItem item = item_of("PPP");
  const auto ask = [&](const char* id, double limit, double value) {
    const assessment::MetricInfo* info = assessment::find_metric(id);
    item.rule.criteria = {{info->id, info->version, assessment::Comparison::at_most, limit}};
    for (auto& one : item.attempts) one.metrics = {{info->id, info->version, value, info->unit, ""}};
    return learning_charts(item).str();
  };
  const std::string shares = ask("advance_visible_share", 0.8, 0.3);
  EXPECT_THAT(shares, HasSubstr(">%</text>"));
  EXPECT_THAT(shares, HasSubstr(">80</text>"));
  EXPECT_THAT(shares, Not(HasSubstr(">share</text>")));
  const std::string counts = ask("skin_punctures", 1.0, 1.0);
  EXPECT_THAT(counts, Not(HasSubstr(">0.95</text>")));
  EXPECT_THAT(counts, HasSubstr(">0</text>"));
  EXPECT_THAT(counts, Not(HasSubstr(">count</text>")));
}

TEST(LearnerReport, SaysWhyThereIsNoNumber) {
  const std::string page = learner_report_page(report_of("-"));
  EXPECT_THAT(page, HasSubstr("Not estimated: there is no value"));
  EXPECT_THAT(page, Not(HasSubstr("nan")));
  EXPECT_THAT(learner_report_page({}), HasSubstr("There is no attempt yet"));
}

assessment::ExpertSet standard_of(std::size_t people, double low, double high) {
  const assessment::MetricInfo* info = assessment::find_metric("tip_target_dist");
  assessment::ExpertSet set;
  set.standard_id = "s";
  assessment::MetricBand& band = set.bands.emplace_back();
  band.id = info->id;
  band.version = info->version;
  band.unit = info->unit;
  band.n = people;
  band.low = low;
  band.high = high;
  return set;
}

// Consultants lie behind the values, n is told, and the drawing tells no more of them than the words.
TEST(LearnerReport, DrawsTheConsultantsBandAsCoarselyAsItIsWritten) {
  LearnerItem item = item_of("FPP");
  EXPECT_THAT(learning_charts(item).str(), Not(HasSubstr("class=\"band\"")));
  item.experts = standard_of(9, 1.0312, 3.4449);
  const std::string drawn = learning_charts(item).str();
  EXPECT_THAT(drawn, HasSubstr("class=\"band\""));
  EXPECT_THAT(drawn, HasSubstr("9 consultants"));
  EXPECT_THAT(drawn, HasSubstr("from the 10th to the 90th percentile of 9 consultants"));
  item.experts = standard_of(9, 0.9688, 3.3651);  // reads the same
  EXPECT_EQ(learning_charts(item).str(), drawn);
  item.experts = standard_of(4, 1.0, 3.4);
  EXPECT_THAT(learning_charts(item).str(), Not(HasSubstr("class=\"band\"")));
  item.experts = standard_of(9, 1.0, 3.4);
  item.experts.standard_id.clear();
  EXPECT_THAT(learning_charts(item).str(), Not(HasSubstr("class=\"band\""))) << "nobody has set it";
}

// Every number that is drawn stands in the table.
TEST(LearnerReport, TheTableHoldsWhatTheChartsDraw) {
  const std::string drawn = learning_charts(item_of("F-P")).str();
  const std::string table = drawn.substr(drawn.find("<table"));
  EXPECT_THAT(table, HasSubstr(">LC-CUSUM<"));
  EXPECT_THAT(table, HasSubstr(">Probability<"));
  std::size_t cells = 0;
  for (std::size_t at = table.find("<td class=\"number\">—"); at != table.npos;
       at = table.find("<td class=\"number\">—", at + 1))
    ++cells;
  EXPECT_EQ(cells, 2U) << "of the attempt that is not graded, and of no other";
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
