// Answers as CSV, read by R: the same values, with missing, not applicable and comments apart.
#include "reports/questionnaires/responses_csv.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <map>

#include "tests/assessment/statistics/r_oracle.h"
#include "tests/fixtures/csv_table.h"
#include "tests/fixtures/folders.h"

namespace seldinger::reports {
namespace {

namespace questionnaire = assessment::questionnaire;
using questionnaire::AnswerState;

const char* const kAsked = R"({"id": "after", "version": 3, "language": "en", "title": "After",
    "scales": [{"id": "s", "points": [{"value": 1, "label": "no"}, {"value": 2}, {"value": 3, "label": "don't know",
      "no_opinion": true}, {"value": 4}, {"value": 5, "label": "yes, \"fully\""}]}],
    "items": [{"id": "real", "text": "R", "kind": "scale", "scale": "s", "not_applicable": true},
      {"id": "wrong", "text": "W", "kind": "scale", "scale": "s", "reverse": true},
      {"id": "post", "text": "P", "kind": "choice", "choices": ["registrar", "consultant"]},
      {"id": "years", "text": "Y", "kind": "number", "least": 0, "most": 70},
      {"id": "more", "text": "M", "kind": "comment"}]})";

casedb::Responses some_responses() {
  casedb::Responses all;
  all.round.code = "ACDEFG";
  casedb::StoredForm form;
  form.form = *questionnaire::form_from_json(kAsked);
  form.body_hash = std::string(64, 'e');
  const std::vector<std::vector<std::string>> typed = {
      {"1", "5", "registrar", "0.1", "NA"},
      {"n/a", "2", "consultant", "33.3", "=1+1, \"odd\"\nsecond line"},
      {"", "", "", "", ""},
      {"3", "3", "registrar", "0", "n/a"},
      {"5", "1", "", "70", "été – 測試"},
  };
  for (std::size_t i = 0; i < typed.size(); ++i) {
    casedb::ResponseSet set;
    set.respondent = "p" + std::to_string(i);
    set.group = i < 2 ? "trainee" : "expert, \"senior\"";
    set.source = i == 0 ? "paper" : "page";
    for (std::size_t j = 0; j < typed[i].size(); ++j) {
      const questionnaire::Item& item = form.form.items[j];
      set.answers.emplace(item.id, *questionnaire::answer_from_text(form.form, item, typed[i][j]));
    }
    all.sets.emplace_back("q", std::move(set));
  }
  all.forms.emplace("q", std::move(form));
  return all;
}

TEST(ResponsesCsv, HasALineForEachRespondentAndItem) {
  const auto table = fixtures::csv_table(responses_csv(some_responses()));
  ASSERT_EQ(table.rows.size(), 25U);
  std::map<std::string, int> states;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    ++states[table.cell(row, "state")];
    EXPECT_EQ(table.cell(row, "form"), "after");
    EXPECT_EQ(table.cell(row, "version"), "3");
    EXPECT_EQ(table.cell(row, "form_sha256"), std::string(64, 'e'));
  }
  EXPECT_EQ(states, (std::map<std::string, int>{{"answered", 18}, {"missing", 6}, {"not_applicable", 1}}));
  EXPECT_EQ(table.cell(1, "value"), "5");
  EXPECT_EQ(table.cell(1, "scored"), "1") << "reverse";
  EXPECT_EQ(table.cell(15, "value"), "3");
  EXPECT_EQ(table.cell(15, "scored"), "") << "don't know is no midpoint";
  EXPECT_EQ(table.cell(9, "comment"), "'=1+1, \"odd\"\nsecond line") << "no formula for a spreadsheet";
}

TEST(ResponsesCsv, HoldsScoresAsStatisticsTakeThem) {
  const auto table = fixtures::csv_table(scores_csv(some_responses()));
  EXPECT_EQ(table.header, (std::vector<std::string>{"respondent", "group", "source", "real", "wrong", "years"}));
  ASSERT_EQ(table.rows.size(), 5U);
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"p0", "trainee", "paper", "1", "1", "0.1"}));
  EXPECT_EQ(table.rows[1], (std::vector<std::string>{"p1", "trainee", "page", "", "4", "33.3"}));
  EXPECT_EQ(table.rows[3], (std::vector<std::string>{"p3", "expert, \"senior\"", "page", "", "", "0"}));
}

TEST(ResponsesCsv, IsWhatRReads) {
  SELDINGER_NEEDS_R();
  const casedb::Responses all = some_responses();
  const auto file = fixtures::fresh_test_folder("responses_csv") / "answers.csv";
  std::ofstream(file, std::ios::binary) << responses_csv(all);
  std::string script = "d <- read.csv('" + file.string() +
                       "', na.strings = '', stringsAsFactors = FALSE, encoding = 'UTF-8', colClasses = c(item = "
                       "'character'))\nsay('rows', nrow(d))\nsay('columns', ncol(d))\n"
                       "for (s in c('missing', 'not_applicable', 'answered')) say(s, sum(d$state == s))\n"
                       "say('comment_na', sum(d$comment == 'NA', na.rm = TRUE))\n"
                       "say('comments', sum(!is.na(d$comment)))\n"
                       "say('real_mean', mean(d$scored[d$item == 'real'], na.rm = TRUE))\n"
                       "say('groups', length(unique(d$group)))\n";
  double expected_sum = 0.0;
  std::size_t row = 0;
  std::map<std::string, double> ours;
  for (const auto& [id, set] : all.sets)
    for (const questionnaire::Item& item : all.forms.at(id).form.items) {
      ++row;
      const std::string name = "v" + std::to_string(row);
      script += "say('" + name + "', d$value[" + std::to_string(row) + "])\n";
      ours[name] = set.answers.at(item.id).value.value_or(std::nan(""));
      expected_sum += set.answers.at(item.id).value.value_or(0.0);
    }
  const auto r = fixtures::r_values(script);
  EXPECT_EQ(r.at("rows"), 25.0);
  EXPECT_EQ(r.at("columns"), 15.0);
  EXPECT_EQ(r.at("missing"), 6.0);
  EXPECT_EQ(r.at("not_applicable"), 1.0);
  EXPECT_EQ(r.at("answered"), 18.0);
  EXPECT_EQ(r.at("comment_na"), 1.0) << "a comment that says NA is a comment";
  EXPECT_EQ(r.at("comments"), 4.0);
  EXPECT_EQ(r.at("real_mean"), 3.0) << "1 and 5; don't know, not applicable and missing are none";
  EXPECT_EQ(r.at("groups"), 2.0);
  for (const auto& [name, value] : ours) {
    if (std::isnan(value)) {
      EXPECT_TRUE(std::isnan(r.at(name))) << name;
    } else {
      EXPECT_EQ(r.at(name), value) << name;
    }
  }
  EXPECT_GT(expected_sum, 0.0);
}

}  // namespace
}  // namespace seldinger::reports
