// Reliability of a study's questionnaires in its report: by round, version and scale, of who answered every item.
#include "reports/studies/numbers/form_reliability.h"

#include <gmock/gmock.h>

#include "assessment/questionnaire/shipped_forms.h"
#include "assessment/statistics/reliability/alpha.h"
#include "reports/studies/validity_sections.h"

namespace seldinger::reports {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
namespace questionnaire = assessment::questionnaire;
namespace statistics = assessment::statistics;

// Answers to the eight statements of 2007's form; 0: not answered.
casedb::Responses answered(const std::vector<std::vector<int>>& people) {
  casedb::Responses responses;
  casedb::StoredForm form;
  form.form = questionnaire::find_shipped_form("workshop-2007")->form;
  responses.round.title = "The <day>";
  responses.forms.emplace("q", form);
  for (const auto& points : people) {
    casedb::ResponseSet set;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (points[i] > 0)
        set.answers[std::string("8") + static_cast<char>('a' + i)] = {questionnaire::AnswerState::answered,
                                                                      1.0 * points[i], ""};
    responses.sets.emplace_back("q", set);
  }
  return responses;
}

const std::vector<std::vector<int>> kPeople = {{4, 4, 3, 4, 5, 4, 4, 3}, {2, 3, 2, 2, 3, 2, 3, 2},
                                               {5, 4, 5, 5, 5, 4, 5, 4}, {3, 3, 3, 2, 3, 4, 3, 3},
                                               {1, 2, 2, 1, 2, 2, 1, 1}, {4, 5, 4, 4, 4, 5, 4, 5}};

TEST(FormReliability, IsOfEachScaleWithSeveralItemsAndOfWholeSets) {
  auto people = kPeople;
  people.push_back({5, 5, 0, 5, 5, 5, 5, 5});
  const auto all = reliability_of(answered(people));
  ASSERT_EQ(all.size(), 1U) << "confidence and similarity are one item each";
  EXPECT_EQ(all[0].items, 8U);
  EXPECT_EQ(all[0].low, 1);
  EXPECT_EQ(all[0].high, 5);
  EXPECT_EQ(all[0].alpha.n, 6U);
  EXPECT_EQ(all[0].alpha.missing, 1U) << "who left one out is left out";
  statistics::CompleteTable table;
  table.rows = kPeople.size();
  for (char c = 'a'; c <= 'h'; ++c) table.columns.push_back(std::string("8") + c);
  for (const auto& points : kPeople) table.values.insert(table.values.end(), points.begin(), points.end());
  ASSERT_TRUE(all[0].alpha.estimate.has_value());
  EXPECT_NEAR(*all[0].alpha.estimate, statistics::cronbach_alpha(table), 1e-12);
}

TEST(FormReliability, StandsInTheReportAsInternalStructure) {
  ValidityReport report;
  report.plan.frozen_us = 1;
  EXPECT_THAT(sources_section(report).str(), HasSubstr("No questionnaire of the study was answered"));
  report.forms = reliability_of(answered(kPeople));
  casedb::RatedRound rated;
  rated.form_title = "Global";
  rated.round_title = "Spring";
  rated.version = 3;
  rated.agreement.ratings = 40;
  rated.agreement.one.estimate = 0.5;
  rated.agreement.one.ci95 = {0.25, 0.75};
  report.rated_rounds.push_back(rated);
  const std::string page = sources_section(report).str();
  EXPECT_THAT(page, HasSubstr("The &lt;day&gt;"));
  EXPECT_THAT(page, HasSubstr("8 on a scale from 1 to 5"));
  EXPECT_THAT(page, HasSubstr("Global, version 3"));
  EXPECT_THAT(page, HasSubstr("<td>40</td><td>0.50 [0.25 to 0.75]</td><td>not estimated"));
  EXPECT_THAT(page, Not(HasSubstr("No questionnaire of the study")));
  report.forms = reliability_of(answered({{3, 3, 3, 3, 3, 3, 3, 3}}));
  EXPECT_THAT(sources_section(report).str(), HasSubstr("not estimated: too few, or all alike")) << "of one person";
}

}  // namespace
}  // namespace seldinger::reports
