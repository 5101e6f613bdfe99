// What groups stated of themselves: quartiles by hand, and of few nothing.
#include "reports/studies/numbers/baseline.h"

#include <gmock/gmock.h>

#include "reports/studies/validity_sections.h"

namespace seldinger::reports {
namespace {

using ::testing::HasSubstr;

TEST(Baseline, IsByGroupAndOfFewWithheld) {
  ValidityReport report;
  report.plan.frozen_us = 1;
  EXPECT_THAT(flow_section(report).str(), HasSubstr("Nobody stated their experience"));
  report.plan.plan.groups = {{"novices", {}, 1}, {"experts", {}, 1}};
  for (int i = 0; i < 9; ++i) {
    casedb::Background& one = report.backgrounds["P-" + std::to_string(i)];
    one.group = i < 5 ? "novices" : "experts";
    one.answers = {{"years_in_radiology", std::to_string(i)}, {"handedness", "left"}};
  }
  const auto rows = baseline_of(report.plan.plan, report.backgrounds);
  ASSERT_EQ(rows.size(), 1U) << "the writing hand is no number";
  EXPECT_EQ(rows[0].groups[0].median, 2.0);
  EXPECT_EQ(rows[0].groups[0].low_quartile, 1.0);
  EXPECT_EQ(rows[0].groups[0].high_quartile, 3.0);
  EXPECT_FALSE(rows[0].groups[1].median) << "of four nothing is told";
  const std::string page = flow_section(report).str();
  EXPECT_THAT(page, HasSubstr("<td>2 (1 to 3), n = 5</td><td>withheld</td>"));
}

}  // namespace
}  // namespace seldinger::reports
