// Ratings beside outcomes in a validity report: the right people, the right case, form by form.
#include <gmock/gmock.h>

#include "reports/studies/validity_sections.h"

namespace seldinger::reports {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
namespace study = assessment::study;

// Six people with values 1 to 6, and one who has failed.
ValidityReport report_with(const std::map<std::string, double>& means, const std::string& case_id = "case") {
  ValidityReport report;
  report.plan.frozen_us = 1;
  study::Compared& compared = report.result.primary.emplace_back();
  compared.outcome.name = "Length of the way";
  compared.outcome.case_id = "case";
  for (int i = 1; i <= 6; ++i)
    compared.people.push_back({"P-" + std::to_string(i), i < 4 ? "a" : "b", study::Standing::value, 1.0 * i, 1});
  compared.people.push_back({"P-7", "a", study::Standing::failure, 0.0, 1});
  casedb::RatedPeople rated{"osats-grs", "Global <rating>", 2, case_id, 14, means};
  if (!means.empty()) report.ratings.push_back(rated);
  return report;
}

TEST(RatingsPanel, HoldsRanksOfOutcomesAgainstRanksOfRatings) {
  const std::string page = sources_section(report_with({{"P-1", 4.5},
                                                        {"P-2", 4.0},
                                                        {"P-3", 3.0},
                                                        {"P-4", 2.5},
                                                        {"P-5", 2.0},
                                                        {"P-6", 1.0},
                                                        {"P-7", 5.0},
                                                        {"P-8", 5.0}}))
                               .str();
  EXPECT_THAT(page, HasSubstr("Global &lt;rating&gt;, version 2, 14 ratings"));
  EXPECT_THAT(page, HasSubstr("lower is better: a ρ below 0 speaks for it"));
  EXPECT_THAT(page, HasSubstr("<td>6</td><td>−1.00")) << "a longer way, a lower rating; failures have no value";
  // By hand: ranks of ratings 1 3 2 4 6 5, so rho = 1 - 6 (1 + 1 + 1 + 1) / (6 * 35).
  const std::string other =
      sources_section(report_with({{"P-1", 1}, {"P-2", 3}, {"P-3", 2}, {"P-4", 4}, {"P-5", 6}, {"P-6", 5}})).str();
  EXPECT_THAT(other, HasSubstr("<td>6</td><td>0.89")) << other;
}

TEST(RatingsPanel, WhatIsTooFewOrOfAnotherCaseIsNoNumber) {
  EXPECT_THAT(sources_section(report_with({{"P-1", 4.0}})).str(),
              HasSubstr("not estimated: too few, or all alike"));
  EXPECT_THAT(sources_section(report_with({{"P-1", 4.0}, {"P-2", 2.0}, {"P-3", 3.0}}, "another")).str(),
              AllOf(Not(HasSubstr("Global")), HasSubstr("No rated replay is of a primary outcome")));
  EXPECT_THAT(sources_section(report_with({})).str(), Not(HasSubstr("What raters saw")));
}

}  // namespace
}  // namespace seldinger::reports
