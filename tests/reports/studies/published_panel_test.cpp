// The study's effect beside published ones: its size by a closed form, whoever did better.
#include <gmock/gmock.h>

#include "reports/studies/validity_sections.h"

namespace seldinger::reports {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
namespace study = assessment::study;

ValidityReport report_of(const std::vector<double>& first, const std::vector<double>& second) {
  ValidityReport report;
  report.plan.frozen_us = 1;
  study::Compared& one = report.result.primary.emplace_back();
  one.outcome.name = "Distance & more";
  one.outcome.first = "a";
  one.outcome.second = "b";
  for (const double value : first) one.people.push_back({"p", "a", study::Standing::value, value, 1});
  for (const double value : second) one.people.push_back({"p", "b", study::Standing::value, value, 1});
  one.people.push_back({"p", "b", study::Standing::failure, 0.0, 1});
  return report;
}

// Means 2 and 5, both SDs 1, three each: d = 3, and Hedges' factor for 4 degrees of freedom is √(4/2) Γ(3/2) / … =
// Γ(2) / (√2 Γ(1.5)) = 0.7979.
TEST(PublishedPanel, TellsTheStudysSizeBesideOthers) {
  for (const bool turned : {false, true}) {
    const auto report = turned ? report_of({4, 5, 6}, {1, 2, 3}) : report_of({1, 2, 3}, {4, 5, 6});
    const std::string panel = published_panel(report).str();
    EXPECT_THAT(panel, HasSubstr("<td>2.39 [")) << panel.substr(panel.find("this study"), 200);
    EXPECT_THAT(panel, HasSubstr("Distance &amp; more"));
    EXPECT_THAT(panel, HasSubstr("Johnson et al."));
    EXPECT_THAT(panel, HasSubstr("<td>3 and 3</td>"));
    EXPECT_THAT(panel, Not(HasSubstr("realism"))) << "answers are no measurements";
  }
}

TEST(PublishedPanel, OfTooFewIsNoEvidence) {
  EXPECT_THAT(published_panel(report_of({1}, {2, 3})).str(), HasSubstr("None yet"));
  EXPECT_THAT(published_panel(report_of({1, 1}, {1, 1})).str(), HasSubstr("None yet"));
}

}  // namespace
}  // namespace seldinger::reports
