// Tests of app/statistics/answer_json and answer_text: nothing of an answer is lost, what is not there is null, and
// what a person reads can be quoted.
#include "app/statistics/answer_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/statistics/answer_text.h"

namespace seldinger::app {
namespace {

using assessment::statistics::Answer;
using Json = nlohmann::json;

Answer an_answer() {
  Answer answer;
  answer.test = "welch";
  answer.method = "Welch's t test";
  answer.n = 20;
  answer.missing = 1;
  answer.groups = {{"é", 12}, {"b", 8}};
  answer.statistic = -1.8608134674868526;
  answer.df = {17.776473516178463};
  answer.p_value = 0.07939414018735823;
  answer.estimate = -1.58;
  answer.estimate_name = "difference of means (é − b)";
  answer.ci95 = {-3.3654832307117444, 0.20548323071174471};
  answer.more = {{"smallest", 4.9406564584124654e-324}, {"tenth", 0.1}};
  answer.rows = {{"é – b", {{"mean", 1e300}, {"whole", 2.0}}}, {"b", {{"mean", 0.25}, {"whole", -12345.678}}}};
  answer.notes = {"A first note.", "A second one."};
  return answer;
}

TEST(AnswerJson, HoldsEveryNumberToItsLastDigit) {
  const Answer answer = an_answer();
  const Json json = Json::parse(json_of_answer(answer));
  EXPECT_EQ(json.at("test"), "welch");
  EXPECT_EQ(json.at("status"), "ok");
  EXPECT_EQ(json.at("reason"), nullptr);
  EXPECT_EQ(json.at("reason_words"), nullptr);
  EXPECT_EQ(json.at("n"), 20);
  EXPECT_EQ(json.at("missing"), 1);
  EXPECT_EQ(json.at("method"), answer.method);
  EXPECT_EQ(json.at("groups"), Json::parse(R"([{"name":"é","n":12},{"name":"b","n":8}])"));
  EXPECT_EQ(json.at("statistic").get<double>(), *answer.statistic);
  EXPECT_EQ(json.at("df").get<double>(), answer.df.front());
  EXPECT_EQ(json.at("p_value").get<double>(), *answer.p_value);
  EXPECT_EQ(json.at("estimate").get<double>(), *answer.estimate);
  EXPECT_EQ(json.at("estimate_name"), answer.estimate_name);
  EXPECT_EQ(json.at("ci95").at(0).get<double>(), answer.ci95->low);
  EXPECT_EQ(json.at("ci95").at(1).get<double>(), answer.ci95->high);
  EXPECT_EQ(json.at("smallest").get<double>(), 4.9406564584124654e-324);
  EXPECT_EQ(json.at("rows").at(0), Json::parse(R"({"name":"é – b","mean":1e300,"whole":2.0})"));
  EXPECT_EQ(json.at("rows").at(1).at("whole").get<double>(), -12345.678);
  EXPECT_EQ(json.at("notes").size(), 2U);
  EXPECT_NE(json_of_answer(answer).find("\"tenth\": 0.1\n"), std::string::npos);
}

TEST(AnswerJson, WhatIsNotThereIsNull) {
  const Json json =
      Json::parse(json_of_answer(assessment::statistics::not_estimable("auc", "one_group", 3, {{"a", 3}})));
  EXPECT_EQ(json.at("status"), "not_estimable");
  EXPECT_EQ(json.at("reason"), "one_group");
  EXPECT_EQ(json.at("reason_words"), "there is only one group");
  for (const char* key : {"method", "statistic", "df", "p_value", "estimate", "estimate_name", "ci95"})
    EXPECT_EQ(json.at(key), nullptr) << key;
  for (const char* key : {"notes", "rows"}) EXPECT_EQ(json.at(key), Json::array()) << key;
  Answer two = an_answer();
  two.df = {2.0, 17.5};
  EXPECT_EQ(Json::parse(json_of_answer(two)).at("df"), Json::parse("[2.0, 17.5]"));
}

TEST(AnswerText, CanBeQuoted) {
  EXPECT_EQ(text_of_answer(an_answer()),
            "welch: Welch's t test\n"
            "  n           20 (é 12, b 8); left out because something is missing: 1\n"
            "  estimate    -1.58 [95 % CI -3.365 to 0.2055], difference of means (é − b)\n"
            "  test        statistic -1.861, df 17.78, p = 0.0794\n"
            "  smallest    4.941e-324\n"
            "  tenth       0.1\n"
            "\n"
            "           mean     whole\n"
            "  é – b  1e+300         2\n"
            "  b        0.25  -12345.7\n"
            "\n"
            "  note: A first note.\n"
            "  note: A second one.\n");
}

TEST(AnswerText, TellsWhyThereIsNone) {
  EXPECT_EQ(text_of_answer(assessment::statistics::not_estimable("auc", "one_group", 3, {{"a", 3}})),
            "auc\n"
            "  n           3 (a 3)\n"
            "  no estimate there is only one group (one_group)\n");
  Answer tiny = an_answer();
  tiny.p_value = 1e-9;
  EXPECT_NE(text_of_answer(tiny).find("p < 0.0001\n"), std::string::npos);
}

}  // namespace
}  // namespace seldinger::app
