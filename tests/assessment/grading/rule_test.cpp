// Pass rules: text and JSON there and back, and what is wrong with one.
#include <gtest/gtest.h>

#include <algorithm>

#include "assessment/grading/rule_json.h"
#include "assessment/grading/usual_limit.h"
#include "assessment/registry.h"

namespace seldinger::assessment {
namespace {

bool has(const std::vector<std::string>& all, const char* one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

std::vector<std::string> codes(const PassRule& rule, const Guidance& guidance) {
  std::vector<std::string> found;
  for (const base::Problem& problem : problems_of(rule, guidance)) found.push_back(problem.code);
  return found;
}

TEST(RuleTest, TextsComeBack) {
  for (const char* text : {"hit >= 1", "tip_target_axial >= -3.5", "skin_punctures@99 <= 1", "gap_share = 0.25"}) {
    const auto criterion = criterion_from(text);
    ASSERT_TRUE(criterion.has_value()) << text;
    EXPECT_EQ(text_of(*criterion), text);
  }
  EXPECT_EQ(text_of(*criterion_from("  hit<=1 ")), "hit <= 1");
  for (const char* text : {"", "hit", "hit >=", ">= 1", "Hit >= 1", "hit > 1", "hit >= x", "hit >= 1e999",
                           "hit >= nan", "hit@0 >= 1", "hit@x >= 1", "hit >= 1 2", "hit; drop >= 1"})
    EXPECT_FALSE(criterion_from(text).has_value()) << text;
}

TEST(RuleTest, ATextWithoutAVersionMeansTheOneInForceAndStoredRulesKeepTheirs) {
  const int in_force = find_metric("path_tip")->version;
  ASSERT_GT(in_force, 1);
  EXPECT_EQ(criterion_from("path_tip <= 90")->version, in_force);  // before: 1, which nothing measures any more
  EXPECT_EQ(criterion_from("path_tip@1 <= 90")->version, 1);
  EXPECT_EQ(text_of(*criterion_from("path_tip@1 <= 90")), "path_tip@1 <= 90") << "never taken for the one in force";
  // As rules were stored when version 1 was in force.
  const auto stored = rule_from_json(
      R"({"criteria":[{"metric":"path_tip","version":1,"comparison":"<=","value":90,"critical":false}]})");
  ASSERT_TRUE(stored.has_value());
  EXPECT_EQ(stored->criteria[0].version, 1);
  EXPECT_NE(json_of_rule(*stored).find("\"version\":1"), std::string::npos);
}

TEST(RuleTest, JsonComesBack) {
  PassRule rule;
  rule.criteria = {{"core_in_target", 3, Comparison::at_least, 0.1 + 0.2, false},
                   {"hand_in_beam", 1, Comparison::equal, 0.0, true}};
  const auto back = rule_from_json(json_of_rule(rule));
  ASSERT_TRUE(back.has_value());
  ASSERT_EQ(back->criteria.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back->criteria[i].metric, rule.criteria[i].metric);
    EXPECT_EQ(back->criteria[i].version, rule.criteria[i].version);
    EXPECT_EQ(back->criteria[i].comparison, rule.criteria[i].comparison);
    EXPECT_EQ(back->criteria[i].value, rule.criteria[i].value);
    EXPECT_EQ(back->criteria[i].critical, rule.criteria[i].critical);
  }
  const auto short_form = rule_from_json(R"({"criteria":[{"metric":"hit","comparison":">=","value":1}]})");
  ASSERT_TRUE(short_form.has_value());
  EXPECT_EQ(short_form->criteria[0].version, find_metric("hit")->version);
}

// A case of an older law measures older versions: what names none means those, as text and in a file, and is no
// problem there.
TEST(RuleTest, WithoutAVersionTheOneThatTheCaseMeasuresIsMeant) {
  const int newest = find_metric("vis_joint")->version;
  Guidance guidance{};
  guidance.manner.modality = cases::Modality::ultrasound;
  for (const auto& [law, version] :
       {std::pair(cases::SightLaw::echo, newest - 4), std::pair(cases::kNewestSightLaw, newest)}) {
    guidance.sight_law = law;
    const auto text = criterion_from("vis_joint >= 0.5", law);
    ASSERT_TRUE(text.has_value());
    EXPECT_EQ(text->version, version);
    const auto json = rule_from_json(R"({"criteria":[{"metric":"vis_joint","comparison":">=","value":0.5}]})", law);
    ASSERT_TRUE(json.has_value());
    EXPECT_EQ(json->criteria.at(0).version, version);
    EXPECT_EQ(usual_criterion(*find_metric("vis_joint"), law).version, version);
    EXPECT_TRUE(problems_of({{*text}}, guidance).empty());
    EXPECT_EQ(criterion_from(text_of(*text), law)->version, version);
    // Which one is named is meant, whatever the case measures.
    EXPECT_EQ(criterion_from("vis_joint@1 >= 0.5", law)->version, 1);
  }
}

TEST(RuleTest, JsonThatIsNoRuleIsRefusedWithAllItsProblems) {
  for (const char* text : {"", "[]", "{}", R"({"criteria":1})", R"({"criteria":[],"more":1})",
                           R"({"criteria":[7]})", R"({"criteria":[{"comparison":">=","value":1}]})",
                           R"({"criteria":[{"metric":"hit","comparison":">","value":1}]})",
                           R"({"criteria":[{"metric":"hit","comparison":">=","value":"1"}]})",
                           R"({"criteria":[{"metric":"hit","comparison":">=","value":1,"version":0}]})",
                           R"({"criteria":[{"metric":"hit","comparison":">=","value":1,"critical":1}]})",
                           R"({"criteria":[{"metric":"hit","comparison":">=","value":1,"weight":1}]})"}) {
    const auto refused = rule_from_json(text);
    ASSERT_FALSE(refused.has_value()) << text;
    EXPECT_EQ(refused.error().code, "bad_rule");
  }
  EXPECT_EQ(rule_from_json(R"({"criteria":[7,{"metric":1}]})").error().findings.size(), 2U);
}

TEST(RuleTest, OnlyWhatMeansSomethingMayBeNamed) {
  const Guidance slices{{cases::Modality::mpr, cases::Approach::in_plane, cases::InstrumentKind::access}};
  const Guidance beam{{cases::Modality::xray, cases::Approach::in_plane, cases::InstrumentKind::core}};
  const Guidance beside{
      {cases::Modality::ultrasound, cases::Approach::out_of_plane, cases::InstrumentKind::access}};
  EXPECT_TRUE(has(meaningful_metrics(slices), "hit"));
  EXPECT_TRUE(has(meaningful_metrics(slices), "advance_visible_share"));
  EXPECT_FALSE(has(meaningful_metrics(slices), "core_in_target"));
  EXPECT_FALSE(has(meaningful_metrics(slices), "dap"));
  EXPECT_TRUE(has(meaningful_metrics(beam), "core_in_target"));
  EXPECT_TRUE(has(meaningful_metrics(beam), "dap"));
  EXPECT_FALSE(has(meaningful_metrics(beam), "advance_visible_share"));
  EXPECT_FALSE(has(meaningful_metrics(beside), "vis_needle"));
  EXPECT_TRUE(has(meaningful_metrics(beside), "skin_punctures"));
}

TEST(RuleTest, AMetricOfAStructureNeedsOne) {
  Guidance guidance;
  guidance.absent = absent_needs({}, false);
  for (const char* id : {"nogo_length", "nogo_length_critical", "capsule_punctures", "must_cross_length",
                         "posterior_wall", "entry_point_error"})
    EXPECT_FALSE(has(meaningful_metrics(guidance), id)) << id;
  std::vector<cases::Structure> structures(2);
  structures[0].rule = cases::StructureRule::critical;
  structures[1].rule = cases::StructureRule::organ;
  guidance.absent = absent_needs(structures, true);
  for (const char* id : {"nogo_length", "nogo_length_critical", "capsule_punctures", "entry_point_error"})
    EXPECT_TRUE(has(meaningful_metrics(guidance), id)) << id;
  for (const char* id : {"nogo_length_major", "must_cross_length", "posterior_wall"})
    EXPECT_FALSE(has(meaningful_metrics(guidance), id)) << id;
}

TEST(RuleTest, OfAPhantomNothingIsAskedThatIsAPatients) {
  Guidance guidance;
  guidance.absent = absent_needs({}, true);
  for (const char* id : {"pain_reactions", "decision_right", "hit", "steps_done"})
    EXPECT_TRUE(has(meaningful_metrics(guidance), id)) << id;
  guidance.absent = absent_needs({}, true, cases::Subject::phantom);
  for (const char* id : {"pain_reactions", "decision_right"})
    EXPECT_FALSE(has(meaningful_metrics(guidance), id)) << id;
  for (const char* id : {"hit", "steps_done", "skin_punctures"})
    EXPECT_TRUE(has(meaningful_metrics(guidance), id)) << id;
}

TEST(RuleTest, EachProblemHasItsCode) {
  const Guidance slices{};
  PassRule rule;
  EXPECT_TRUE(codes(rule, slices).empty());
  rule.criteria = {*criterion_from("hit >= 1")};
  EXPECT_TRUE(codes(rule, slices).empty());
  rule.criteria = {*criterion_from("hit >= 1"), *criterion_from("hit >= 1")};
  EXPECT_EQ(codes(rule, slices), std::vector<std::string>{"twice"});
  rule.criteria = {*criterion_from("gut_feeling >= 1")};
  EXPECT_EQ(codes(rule, slices), std::vector<std::string>{"unknown_metric"});
  rule.criteria = {*criterion_from("hit@99 >= 1")};
  EXPECT_EQ(codes(rule, slices), std::vector<std::string>{"other_version"});
  // A draft that was raised to a newer law of sight keeps its rule, and is told what to name.
  const int newest = find_metric("vis_joint")->version;
  rule.criteria = {*criterion_from("vis_joint@" + std::to_string(newest - 1) + " >= 0.5")};
  Guidance pictures{};
  pictures.manner.modality = cases::Modality::ultrasound;
  ASSERT_EQ(problems_of(rule, pictures).size(), 1U);
  EXPECT_EQ(problems_of(rule, pictures)[0].text, "vis_joint is measured by version " + std::to_string(newest) +
                                                     ", not " + std::to_string(newest - 1) +
                                                     ": name that one, and see whether the limit still fits");
  pictures.sight_law = cases::SightLaw::material;
  EXPECT_TRUE(problems_of(rule, pictures).empty());
  rule.criteria = {*criterion_from("dap <= 1")};
  EXPECT_EQ(codes(rule, slices), std::vector<std::string>{"not_meaningful"});
}

}  // namespace
}  // namespace seldinger::assessment
