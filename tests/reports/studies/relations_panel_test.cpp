// Outcomes beside ratings and stated experience in a validity report: the right people, the right case, form by
// form, and what their unreliability hides.
#include <gmock/gmock.h>

#include <cmath>

#include "reports/studies/numbers/relations.h"
#include "reports/studies/validity_sections.h"

namespace seldinger::reports {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
namespace study = assessment::study;

// Six people with values 1 to 6, and one who has failed.
ValidityReport rated_report(const std::map<std::string, double>& means, const std::string& case_id = "case") {
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

TEST(RelationsPanel, HoldsRanksOfOutcomesAgainstRanksOfRatings) {
  const std::string page = sources_section(rated_report({{"P-1", 4.5},
                                                         {"P-2", 4.0},
                                                         {"P-3", 3.0},
                                                         {"P-4", 2.5},
                                                         {"P-5", 2.0},
                                                         {"P-6", 1.0},
                                                         {"P-7", 5.0},
                                                         {"P-8", 5.0}}))
                               .str();
  EXPECT_THAT(page, HasSubstr("Mean rating: Global &lt;rating&gt;, version 2 <span class=\"why\">14 ratings"));
  EXPECT_THAT(page, HasSubstr("lower is better: a ρ below 0 speaks for it"));
  EXPECT_THAT(page, HasSubstr("<td>6</td><td>−1.00")) << "a longer way, a lower rating; failures have no value";
  // By hand: ranks of ratings 1 3 2 4 6 5, so rho = 1 - 6 (1 + 1 + 1 + 1) / (6 * 35).
  const std::string other =
      sources_section(rated_report({{"P-1", 1}, {"P-2", 3}, {"P-3", 2}, {"P-4", 4}, {"P-5", 6}, {"P-6", 5}})).str();
  EXPECT_THAT(other, HasSubstr("<td>6</td><td>0.89")) << other;
}

TEST(RelationsPanel, WhatIsTooFewOrOfAnotherCaseIsNoNumber) {
  EXPECT_THAT(sources_section(rated_report({{"P-1", 4.0}})).str(),
              HasSubstr("not estimated: too few, or all alike"));
  EXPECT_THAT(sources_section(rated_report({{"P-1", 4.0}, {"P-2", 2.0}, {"P-3", 3.0}}, "another")).str(),
              AllOf(Not(HasSubstr("Global")),
                    HasSubstr("No rated replay shows a primary outcome’s case, and nobody stated")));
  EXPECT_THAT(sources_section(rated_report({})).str(),
              HasSubstr("What raters saw, and what experience people stated</h3>\n<p><strong>None yet"));
}

// Two attempts each, whose ranks differ in one pair: r = 1 - 6 * 2 / (6 * 35), stepped up 2 r / (1 + r).
TEST(Relations, ReliabilityOfAnOutcomeIsOfItsHalves) {
  ValidityReport report = rated_report({});
  study::Compared& one = report.result.primary.front();
  const double second[] = {2, 1, 3, 4, 5, 6};
  for (int i = 0; i < 6; ++i) one.people[static_cast<std::size_t>(i)].values = {1.0 * (i + 1), second[i]};
  const double r = 1.0 - 12.0 / 210.0;
  ASSERT_TRUE(value_reliability(one).value);
  EXPECT_NEAR(*value_reliability(one).value, 2.0 * r / (1.0 + r), 1e-12);
  one.people[0].values = {1.0, 6.0, 3.0};
  EXPECT_EQ(halves_of(one.people[0]), std::pair(2.0, 6.0)) << "every other attempt";
  for (study::PersonValue& person : one.people) person.values.resize(1);
  EXPECT_THAT(value_reliability(one).why_not, HasSubstr("fewer than three persons"));
  for (std::size_t i = 0; i < 6; ++i)
    one.people[i].values = {1.0 * static_cast<double>(i), -1.0 * static_cast<double>(i)};
  EXPECT_THAT(value_reliability(one).why_not, HasSubstr("do not agree"));
}

// ρ over the root of both reliabilities, and so its interval (Spearman 1904).
TEST(Relations, CorrectedIsRawOverTheRootOfBoth) {
  const ValidityReport report = rated_report({});
  const Other other{"x", "", {{"P-1", 1}, {"P-2", 3}, {"P-3", 2}, {"P-4", 4}, {"P-5", 6}, {"P-6", 5}}, {0.8, ""}};
  const Related found = related(report.result.primary.front(), other, {0.5, ""});
  ASSERT_TRUE(found.corrected && found.corrected_ci95 && found.raw.ci95);
  EXPECT_NEAR(*found.corrected, *found.raw.estimate / std::sqrt(0.4), 1e-12);
  EXPECT_NEAR(found.corrected_ci95->low, found.raw.ci95->low / std::sqrt(0.4), 1e-12);
  EXPECT_NEAR(found.corrected_ci95->high, found.raw.ci95->high / std::sqrt(0.4), 1e-12);
  EXPECT_THAT(related(report.result.primary.front(), other, {{}, "why"}).why_not_corrected, "the outcome: why");
}

TEST(RelationsPanel, ExperienceIsWhatWasStatedAndHasNoReliability) {
  ValidityReport report = rated_report({});
  for (int i = 1; i <= 6; ++i)
    report.backgrounds["P-" + std::to_string(i)].answers = {{"logbook_total", std::to_string(70 - 10 * i)},
                                                            {"handedness", "left"}};
  const std::string page = relations_panel(report).str();
  EXPECT_THAT(page, HasSubstr("Interventional procedures in your logbook"));
  EXPECT_THAT(page, HasSubstr("<td>6</td><td>−1.00"));
  EXPECT_THAT(page, HasSubstr("not estimated: the outcome: fewer than three persons"));
  EXPECT_THAT(page, Not(HasSubstr("Writing hand"))) << "no number";
  for (study::PersonValue& person : report.result.primary.front().people)
    person.values = {person.value, person.value};
  EXPECT_THAT(relations_panel(report).str(), HasSubstr("not estimated: the other: it was stated once"));
}

}  // namespace
}  // namespace seldinger::reports
