// Rules that nobody can pass, and rules that look odd and can be passed.
#include "assessment/grading/contradictions.h"

#include <gtest/gtest.h>

#include <string>

namespace seldinger::assessment {
namespace {

std::vector<base::Problem> found_in(std::initializer_list<const char*> criteria, const Guidance& guidance = {}) {
  PassRule rule;
  for (const char* text : criteria) rule.criteria.push_back(*criterion_from(text));
  return contradictions_of(rule, guidance);
}

std::string code_of(std::initializer_list<const char*> criteria, const Guidance& guidance = {}) {
  std::string codes;
  for (const base::Problem& one : found_in(criteria, guidance)) codes += one.code + " ";
  return codes;
}

TEST(ContradictionsTest, ALimitThatTheMetricNeverReaches) {
  for (const char* text : {"vis_joint >= 80", "vis_joint <= -0.1", "vis_joint >= 1.01", "collimated_share <= 2",
                           "hit >= 2", "hit = 0.5", "skin_punctures <= -1", "skin_punctures = 1.5",
                           "blind_advance_max <= -0.5", "clearance_min >= 21", "view_angle_max >= 91", "ldlj >= 1"})
    EXPECT_EQ(code_of({text}), "never_met ") << text;
  for (const char* text :
       {"vis_joint >= 1", "vis_joint >= 0", "hit >= 1", "hit = 0", "hit >= 0.5", "skin_punctures <= 0",
        "skin_punctures >= -1", "tip_target_surface <= -3", "tip_target_axial >= -3", "clearance_min >= 20",
        "ldlj >= -6", "path_inefficiency <= 250"})
    EXPECT_EQ(code_of({text}), "") << text;
  EXPECT_EQ(
      found_in({"vis_joint >= 80"})[0].text,
      "“Needle and target visible: at least 8000 %” (vis_joint >= 80) can never be met: a share lies between 0 "
      "and 1: 80 % is 0.8");
}

TEST(ContradictionsTest, NoCoreIsLongerThanTheNotch) {
  Guidance guidance;
  EXPECT_EQ(code_of({"core_in_target >= 20"}, guidance), "") << "nothing is known of the needle";
  guidance.notch_mm = 18.0;
  EXPECT_EQ(code_of({"core_in_target >= 18"}, guidance), "");
  EXPECT_EQ(code_of({"core_in_target >= 18.5"}, guidance), "never_met ");
}

TEST(ContradictionsTest, TwoBoundsOfOneMetric) {
  EXPECT_EQ(code_of({"tip_target_axial >= -3", "tip_target_axial <= 3"}), "");
  EXPECT_EQ(code_of({"time_total >= 5", "time_total <= 5"}), "");
  EXPECT_EQ(code_of({"time_total >= 90", "time_total <= 60"}), "contradictory ");
  EXPECT_EQ(code_of({"skin_punctures = 1", "skin_punctures >= 2"}), "contradictory ");
  EXPECT_EQ(code_of({"skin_punctures = 1", "skin_punctures = 2"}), "contradictory ");
}

TEST(ContradictionsTest, OneCriterionRulesTheOtherOut) {
  EXPECT_EQ(code_of({"hit >= 1", "skin_punctures <= 0"}), "contradictory ");
  EXPECT_EQ(code_of({"skin_punctures <= 0", "core_in_target >= 8"}), "contradictory ");
  EXPECT_EQ(code_of({"first_pass_success >= 1", "hit = 0"}), "contradictory ");
  EXPECT_EQ(code_of({"first_pass_success >= 1", "skin_punctures >= 2"}), "contradictory ");
  EXPECT_EQ(code_of({"fired_breath_held >= 1", "breath_holds_asked <= 0"}), "contradictory ");
  EXPECT_EQ(code_of({"vis_joint >= 0.8", "vis_needle <= 0.5"}), "contradictory ");
  EXPECT_EQ(code_of({"pulses <= 1", "view_angle_max >= 30"}), "contradictory ") << "over two steps";
  EXPECT_EQ(code_of({"skin_punctures <= 0", "entry_point_error <= 5"}), "contradictory ") << "no value without one";
  EXPECT_EQ(code_of({"skin_punctures <= 0", "blind_advance <= 5"}), "contradictory ") << "no value without one";
  EXPECT_EQ(code_of({"hit >= 1", "skin_punctures <= 1", "blind_advance_max <= 5", "nogo_length <= 0"}), "");
  EXPECT_EQ(found_in({"skin_punctures <= 0", "hit >= 1"})[0].text,
            "“Skin punctures: none” (skin_punctures <= 0) and “Target hit: yes” (hit >= 1) cannot both be met: the "
            "target lies under the skin");
}

TEST(ContradictionsTest, WhoIsToDeferMayAskForNoPunctureAndForNothingOfOne) {
  Guidance defer;
  defer.defer_is_right = true;
  EXPECT_EQ(code_of({"decision_right >= 1", "skin_punctures <= 0"}, defer), "");
  EXPECT_EQ(code_of({"decision_right >= 1", "hit >= 1"}, defer), "contradictory ");
  EXPECT_EQ(code_of({"decision_right >= 1", "hit >= 1"}), "") << "where to go ahead is right";
}

TEST(ContradictionsTest, EachPairIsToldOnceAndWhatIsOtherwiseWrongIsLeftToItsOwnCheck) {
  EXPECT_EQ(code_of({"first_pass_success >= 1", "skin_punctures <= 0"}), "contradictory ");
  EXPECT_EQ(code_of({"hit >= 1", "core_in_target >= 5", "skin_punctures <= 0"}), "contradictory contradictory ");
  EXPECT_EQ(code_of({"luck >= 2", "hit@99 >= 2"}), "");
  EXPECT_EQ(code_of({"hit >= 2", "skin_punctures <= 0"}), "never_met ") << "one thing is wrong, not two";
}

}  // namespace
}  // namespace seldinger::assessment
