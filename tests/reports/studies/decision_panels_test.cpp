// Internal structure and consequences in a validity report: from attempts of people, a rule and a cut.
#include <gmock/gmock.h>

#include <cmath>

#include "assessment/registry.h"
#include "reports/studies/outcome_table.h"
#include "reports/studies/validity_sections.h"
#include "sim/base/rng.h"

namespace seldinger::reports {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
namespace study = assessment::study;

// Twenty persons with two attempts each: true values 2 to 8 mm, an error of `error_mm`.
ValidityReport report_with(double error_mm, std::size_t attempts = 2) {
  ValidityReport report;
  report.plan.frozen_us = 1;
  study::Compared& compared = report.result.primary.emplace_back();
  compared.outcome.name = "Distance";
  compared.outcome.metric = "tip_target_dist";
  compared.outcome.version = assessment::find_metric("tip_target_dist")->version;
  compared.outcome.case_id = "case";
  compared.outcome.first = "novices";
  compared.outcome.second = "experts";
  base::Rng rng(3);
  for (int i = 0; i < 20; ++i) {
    study::PersonValue person{"P-" + std::to_string(i), i < 10 ? "novices" : "experts", study::Standing::value, 0.0,
                              attempts};
    const double truly = (i < 10 ? 6.0 : 4.0) + 1.5 * rng.normal();
    for (std::size_t k = 0; k < attempts; ++k) person.values.push_back(truly + error_mm * rng.normal());
    person.value = person.values.back();
    compared.people.push_back(std::move(person));
  }
  compared.people.push_back({"P-20", "novices", study::Standing::failure, 0.0, 1});
  return report;
}

// The legend tells of a band only where one is drawn.
TEST(Conclusions, TellOfTheBandWhereItIsDrawn) {
  ValidityReport report = report_with(1.0);
  study::Compared& one = report.result.primary.front();
  one.answer.estimate = 0.7;
  one.outcome.test = study::Test::brunner_munzel;
  EXPECT_FALSE(draws_worthwhile(report.result.primary));
  EXPECT_THAT(conclusions_section(report).str(), Not(HasSubstr("grey band")));
  one.outcome.test = study::Test::welch;
  EXPECT_TRUE(draws_worthwhile(report.result.primary));
  EXPECT_THAT(conclusions_section(report).str(), HasSubstr("no difference; the grey band"));
}

// Whom nobody asked does not consent.
TEST(WhoMayBeIn, IsWhoConsentsOrASimulatedPerson) {
  ValidityReport draft;
  draft.blinded = {{1, false}, 1, 4};
  EXPECT_THAT(conclusions_section(draft).str(), HasSubstr("<li>1 consents</li>"));
  draft.blinded.people = {12, true};
  EXPECT_THAT(conclusions_section(draft).str(), HasSubstr("<li>12 simulated people</li>"));
  EXPECT_THAT(conclusions_section(draft).str(), Not(HasSubstr("consent")));
  ValidityReport report = report_with(1.0);
  report.flow.people = {12, false};
  report.flow.groups = {{"novices", 10, 0, 10, 10}};
  EXPECT_THAT(flow_section(report).str(), HasSubstr("<strong>12</strong> consent<"));
  EXPECT_THAT(flow_section(report).str(), HasSubstr("withdrew consent since"));
  EXPECT_THAT(flow_section(report).str(), HasSubstr("in the group by their facts"));
  report.flow.people.simulated = true;
  EXPECT_THAT(flow_section(report).str(), HasSubstr("<strong>12</strong> simulated people<"));
  EXPECT_THAT(flow_section(report).str(), Not(HasSubstr("consent")));
}

TEST(InternalStructure, TellsAgreementAndError) {
  const std::string sound = internal_structure_panel(report_with(0.01)).str();
  EXPECT_THAT(sound, HasSubstr("<td>20</td><td>1.00"));
  EXPECT_THAT(sound, HasSubstr("<div class=\"wide\"")) << "a narrow page scrolls it and cuts nothing off";
  EXPECT_THAT(sound, HasSubstr("<td>0.0"));
  const std::string noisy = internal_structure_panel(report_with(20.0)).str();
  EXPECT_THAT(noisy, Not(HasSubstr("<td>1.00")));
  EXPECT_THAT(internal_structure_panel(report_with(1.0, 1)).str(), HasSubstr("not estimated: there"));
}

TEST(Consequences, AreThoseOfTheRuleOrOfAFrozenCut) {
  ValidityReport report = report_with(0.8);
  EXPECT_THAT(consequences_panel(report).str(), HasSubstr("None yet."));
  const int version = report.result.primary.front().outcome.version;
  report.marks.rules["case"].criteria = {{"tip_target_dist", version, assessment::Comparison::at_most, 5.0}};
  const std::string by_rule = consequences_panel(report).str();
  EXPECT_THAT(by_rule, HasSubstr("at most 5 mm <span class=\"why\">the case’s rule"));
  EXPECT_THAT(by_rule, HasSubstr(" of 11 ")) << "who failed is not at the mark, and counts";
  EXPECT_THAT(by_rule, HasSubstr("alike a second time"));

  casedb::Cut cut;
  cut.metric_id = "tip_target_dist";
  cut.version = version;
  cut.higher_is_better = false;
  cut.value = 1000.0;
  cut.words = "contrasting";
  report.marks.cuts["case"] = {cut};
  EXPECT_THAT(consequences_panel(report).str(), HasSubstr("the case’s rule")) << "nobody has frozen it";
  report.marks.cuts["case"].front().frozen_us = 1;
  const std::string by_cut = consequences_panel(report).str();
  EXPECT_THAT(by_cut, HasSubstr("the frozen cut (contrasting)"));
  EXPECT_THAT(by_cut, HasSubstr("novices: 10 of 11"));
  EXPECT_THAT(by_cut, HasSubstr("experts: 10 of 10"));
}

TEST(Consequences, SayThatReliabilityIsNotKnown) {
  ValidityReport report = report_with(0.8, 1);
  const int version = report.result.primary.front().outcome.version;
  report.marks.rules["case"].criteria = {{"tip_target_dist", version, assessment::Comparison::at_most, 5.0}};
  EXPECT_THAT(consequences_panel(report).str(), HasSubstr("the reliability is not known"));
}

}  // namespace
}  // namespace seldinger::reports
