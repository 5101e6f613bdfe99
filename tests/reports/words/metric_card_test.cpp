// What somebody reads who asks what a number means: complete, and in words.
#include "reports/words/metric_card.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "assessment/grading/reason_words.h"
#include "assessment/registry.h"
#include "tests/reports/words/card_line.h"

namespace seldinger::reports {
namespace {

TEST(MetricCardTest, EveryMetricTellsAllThereIsToAsk) {
  for (const assessment::MetricInfo& info : assessment::registry()) {
    const Card card = metric_card(info.id);
    EXPECT_EQ(card.label, info.label);
    EXPECT_FALSE(card.definition.empty()) << info.id;
    for (const char* name : {"Unit", "Better", "No value if", "Version", "Source"})
      EXPECT_FALSE(line_of(card, name).empty()) << info.id << " " << name;
  }
}

// A symbol of a formula (v_peak) is no code.
TEST(MetricCardTest, NoCodeIsLeftForAReader) {
  const std::regex code("[a-z0-9]+(_[a-z0-9]+)+");
  const auto codes_in = [&](const std::string& text) {
    std::string found;
    for (std::sregex_iterator one(text.begin(), text.end(), code), end; one != end; ++one)
      if (assessment::find_metric(one->str()) != nullptr || assessment::find_reason_words(one->str()) != nullptr)
        found += one->str() + " ";
    return found;
  };
  for (const assessment::MetricInfo& info : assessment::registry()) {
    const Card card = metric_card(info.id);
    EXPECT_EQ(codes_in(card.definition), "") << card.definition;
    EXPECT_EQ(card.definition.find("Null:"), std::string::npos) << card.definition;
    const std::string nulls = line_of(card, "No value if");
    EXPECT_EQ(nulls.find('_'), std::string::npos) << nulls;
  }
}

TEST(MetricCardTest, SaysWhenAValueIsNullAndWhichDefinitionItIsOf) {
  const int now = assessment::find_metric("time_puncture_to_target")->version;
  Card card = metric_card("time_puncture_to_target", now);
  const std::string nulls = line_of(card, "No value if");
  EXPECT_NE(nulls.find("the needle was neither fired nor declared to be on target"), std::string::npos) << nulls;
  EXPECT_NE(nulls.find("the skin was never punctured"), std::string::npos) << nulls;
  EXPECT_EQ(line_of(card, "Version").find("this value"), std::string::npos);
  card = metric_card("time_puncture_to_target", now + 1);
  EXPECT_NE(line_of(card, "Version").find("this value was measured by version " + std::to_string(now + 1)),
            std::string::npos);
}

TEST(MetricCardTest, AnotherMetricIsCalledByItsName) {
  const std::string definition = metric_card("vis_joint").definition;
  EXPECT_NE(definition.find("“" + std::string(assessment::find_metric("vis_needle")->label) + "”"),
            std::string::npos)
      << definition;
}

TEST(MetricCardTest, OfAnUnknownMetricSaysThatItIsUnknown) {
  const Card card = metric_card("of_tomorrow", 3);
  EXPECT_EQ(card.label, "of tomorrow");
  EXPECT_TRUE(card.lines.empty());
  EXPECT_NE(card.definition.find("does not know"), std::string::npos);
}

}  // namespace
}  // namespace seldinger::reports
