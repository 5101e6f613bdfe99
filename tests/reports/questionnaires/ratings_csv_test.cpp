// Ratings as CSV: a simulated rater's say so.
#include "reports/questionnaires/ratings_csv.h"

#include <gtest/gtest.h>

#include "assessment/questionnaire/shipped_forms.h"
#include "tests/fixtures/csv_table.h"

namespace seldinger::reports {
namespace {

namespace questionnaire = assessment::questionnaire;

TEST(RatingsCsv, TellsWhichAreSimulated) {
  casedb::SentRatings sent;
  sent.round.code = "ACDEFG";
  sent.form.form = *questionnaire::form_from_json(std::string(questionnaire::find_shipped_form("osats-grs")->json));
  for (const bool simulated : {true, false}) {
    casedb::SentRating& one = sent.ratings.emplace_back();
    one.rater = simulated ? "R1" : "R2";
    one.number = 7;
    one.simulated = simulated;
    one.answers.emplace("flow", questionnaire::ItemAnswer{questionnaire::AnswerState::answered, 4.0, {}});
  }
  const auto table = fixtures::csv_table(ratings_csv(sent, false));
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.cell(0, "simulated"), "1");
  EXPECT_EQ(table.cell(1, "simulated"), "0");
  EXPECT_EQ(table.cell(0, "number"), "7");
  EXPECT_EQ(table.cell(0, "flow"), "4");
}

}  // namespace
}  // namespace seldinger::reports
