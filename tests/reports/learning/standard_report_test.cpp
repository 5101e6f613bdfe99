// Cuts on one axis, with what they rest on and which one holds.
#include "reports/learning/standard_report.h"

#include <gmock/gmock.h>

namespace seldinger::reports {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

casedb::Cut cut(const std::string& method, double value, std::optional<std::int64_t> frozen_us,
                const std::string& metric = "tip_target_dist") {
  casedb::Cut made;
  made.cut_id = method;
  made.metric_id = metric;
  made.higher_is_better = metric.empty();
  made.method = method;
  made.data = "value,group\n1,\"<b>\"\n";
  made.value = value;
  made.interval = assessment::statistics::Interval{value - 1.0, value + 1.0};
  made.n = 12;
  made.words = "by a method";
  made.proposed_by = "P-1";
  made.frozen_us = frozen_us;
  if (frozen_us) made.frozen_by = "P-2";
  return made;
}

StandardReport cuts_report(std::vector<casedb::Cut> cuts) {
  StandardReport report;
  report.title = "Liver <25 mm>";
  report.program_version = "1";
  report.rule.criteria = {{"tip_target_dist", 1, assessment::Comparison::at_most, 5.0}};
  report.cuts = std::move(cuts);
  report.dependability = assessment::statistics::not_estimable("g_theory", "too_few", 1);
  return report;
}

TEST(StandardReport, PutsMethodsOnOneAxisAndMarksTheOneThatHolds) {
  const std::string page = standard_report_page(
      cuts_report({cut("contrasting_groups", 4.0, {}), cut("borderline", 5.5, 7), cut("angoff", 0.6, {}, "")}));
  EXPECT_THAT(page, HasSubstr("Liver &lt;25 mm&gt;"));
  EXPECT_THAT(page, HasSubstr("Contrasting groups"));
  EXPECT_THAT(page, HasSubstr("at most 5.5 mm (4.5 to 6.5), n = 12, Borderline persons</strong> holds"));
  EXPECT_THAT(page, HasSubstr("The case’s rule asks for at most 5 mm."));
  EXPECT_THAT(page, HasSubstr("frozen by P-2"));
  EXPECT_THAT(page, HasSubstr("Φ is not estimated: there are too few values"));
  EXPECT_THAT(page, HasSubstr("Share of items that are right"));
  EXPECT_THAT(page, HasSubstr("&quot;&lt;b&gt;&quot;"));
  std::size_t charts = 0, marked = 0;
  for (std::size_t at = 0; (at = page.find("<svg class=\"intervals\"", at)) != page.npos; ++at) ++charts;
  for (std::size_t at = 0; (at = page.find("estimate marked", at)) != page.npos; ++at) ++marked;
  EXPECT_EQ(charts, 2U) << "millimetres and shares have an axis each";
  EXPECT_EQ(marked, 1U);
}

TEST(StandardReport, SaysThatNothingHoldsYet) {
  EXPECT_THAT(standard_report_page(cuts_report({})), HasSubstr("Nobody has proposed a cut"));
  const std::string page = standard_report_page(cuts_report({cut("hofstee", 4.0, {})}));
  EXPECT_THAT(page, HasSubstr("None is frozen yet"));
  EXPECT_THAT(page, Not(HasSubstr("estimate marked")));
}

}  // namespace
}  // namespace seldinger::reports
