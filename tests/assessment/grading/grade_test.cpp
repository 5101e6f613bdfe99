// Grades: every combination of what a criterion may come to, critical or not; versions, time limits, what is not
// gradable.
#include "assessment/grading/grade.h"

#include <gtest/gtest.h>

#include <limits>

#include "assessment/registry.h"
#include "tests/assessment/grading/graded_samples.h"

namespace seldinger::assessment {
namespace {

enum class Kind { met, missed, null, not_a_number, other_version, not_stored };
constexpr Kind kKinds[] = {Kind::met,          Kind::missed,        Kind::null,
                           Kind::not_a_number, Kind::other_version, Kind::not_stored};

// A metric of three, each with its criterion "at most 1".
constexpr const char* kIds[] = {"skin_punctures", "blind_advance_max", "nogo_length_critical"};

int in_force(const char* id) {
  return find_metric(id)->version;
}

void add(Kind kind, const char* id, std::vector<MetricValue>& metrics) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  switch (kind) {
    case Kind::met:
      metrics.push_back({id, 1, 1.0, "mm", ""});
      break;
    case Kind::missed:
      metrics.push_back({id, 1, 1.5, "mm", ""});
      break;
    case Kind::null:
      metrics.push_back({id, 1, std::nullopt, "mm", "never_in_tissue"});
      break;
    case Kind::not_a_number:
      metrics.push_back({id, 1, nan, "mm", ""});
      break;
    case Kind::other_version:
      metrics.push_back({id, 2, 0.0, "mm", ""});
      break;
    case Kind::not_stored:
      break;
  }
}

TEST(GradeTest, PassesExactlyWhenEveryCriterionIsMetWhateverIsCritical) {
  int passed = 0;
  for (const Kind a : kKinds)
    for (const Kind b : kKinds)
      for (const Kind c : kKinds)
        for (unsigned critical = 0; critical < 8; ++critical) {
          const Kind kinds[] = {a, b, c};
          std::vector<MetricValue> metrics = good_quality();
          PassRule rule;
          std::size_t met = 0, errors = 0, not_comparable = 0;
          for (unsigned i = 0; i < 3; ++i) {
            add(kinds[i], kIds[i], metrics);
            const bool is_critical = (critical & (1U << i)) != 0;
            rule.criteria.push_back({kIds[i], 1, Comparison::at_most, 1.0, is_critical});
            met += kinds[i] == Kind::met ? 1U : 0U;
            not_comparable += kinds[i] == Kind::other_version ? 1U : 0U;
            errors += is_critical && kinds[i] == Kind::missed ? 1U : 0U;
          }
          const Grade made = grade(rule, {metrics, "", {}});
          const bool only_not_comparable = not_comparable > 0 && met + not_comparable == 3;
          EXPECT_EQ(made.verdict, met == 3              ? Verdict::passed
                                  : only_not_comparable ? Verdict::not_gradable
                                                        : Verdict::failed);
          EXPECT_EQ(made.reason, only_not_comparable ? "other_version" : "");
          EXPECT_EQ(made.met(), met);
          EXPECT_EQ(made.critical_errors(), errors);
          ASSERT_EQ(made.criteria.size(), 3U);
          for (std::size_t i = 0; i < errors; ++i) EXPECT_TRUE(made.criteria[i].critical_error());
          passed += made.verdict == Verdict::passed ? 1 : 0;
        }
  EXPECT_EQ(passed, 8);  // all met, with each choice of what is critical
}

TEST(GradeTest, SaysWhyACriterionHasNoValue) {
  const std::pair<Kind, const char*> reasons[] = {{Kind::null, "never_in_tissue"},
                                                  {Kind::not_a_number, "not_finite"},
                                                  {Kind::other_version, "other_version"},
                                                  {Kind::not_stored, "not_stored"}};
  for (const auto& [kind, reason] : reasons) {
    std::vector<MetricValue> metrics = good_quality();
    add(kind, "skin_punctures", metrics);
    const Grade made = grade(rule_of({"skin_punctures@1 <= 1"}, {}), {metrics, "", {}});
    // Before: failed, so that no new attempt could pass a case published with an older definition.
    EXPECT_EQ(made.verdict, kind == Kind::other_version ? Verdict::not_gradable : Verdict::failed);
    EXPECT_EQ(made.criteria[0].outcome, Outcome::not_measured);
    EXPECT_EQ(made.criteria[0].reason, reason);
    EXPECT_FALSE(made.criteria[0].value.has_value());
    EXPECT_FALSE(made.criteria[0].critical_error());
  }
}

TEST(GradeTest, ComparesAsTheRuleSays) {
  const auto outcome = [](const char* criterion, double value) {
    std::vector<MetricValue> metrics = good_quality();
    metrics.push_back({"hit", in_force("hit"), value, "bool", ""});
    return grade(rule_of({criterion}, {}), {metrics, "", {}}).criteria[0].outcome;
  };
  for (const auto& [criterion, low, equal, high] :
       {std::tuple{"hit >= 2", Outcome::missed, Outcome::met, Outcome::met},
        std::tuple{"hit <= 2", Outcome::met, Outcome::met, Outcome::missed},
        std::tuple{"hit = 2", Outcome::missed, Outcome::met, Outcome::missed}}) {
    EXPECT_EQ(outcome(criterion, 1.999), low) << criterion;
    EXPECT_EQ(outcome(criterion, 2.0), equal) << criterion;
    EXPECT_EQ(outcome(criterion, 2.001), high) << criterion;
  }
}

TEST(GradeTest, TakesTheVersionThatTheRuleNames) {
  std::vector<MetricValue> metrics = good_quality();
  metrics.push_back({"path_tip", 1, 400.0, "mm", ""});
  metrics.push_back({"path_tip", 2, 100.0, "mm", ""});
  EXPECT_EQ(grade(rule_of({"path_tip@1 <= 200"}, {}), {metrics, "", {}}).verdict, Verdict::failed);
  EXPECT_EQ(grade(rule_of({"path_tip@2 <= 200"}, {}), {metrics, "", {}}).verdict, Verdict::passed);
  EXPECT_EQ(grade(rule_of({"path_tip@99 <= 200"}, {}), {metrics, "", {}}).criteria[0].reason, "other_version");
}

TEST(GradeTest, CriticalErrorsComeFirstAndWhatWasMetLast) {
  std::vector<MetricValue> metrics = good_quality();
  metrics.push_back({"hit", in_force("hit"), 1.0, "bool", ""});
  metrics.push_back({"skin_punctures", in_force("skin_punctures"), 3.0, "count", ""});
  metrics.push_back({"blind_advance_max", in_force("blind_advance_max"), std::nullopt, "mm", "no_picture"});
  metrics.push_back({"nogo_length_critical", in_force("nogo_length_critical"), 2.0, "mm", ""});
  const Grade made = grade(rule_of({"hit >= 1", "blind_advance_max <= 5", "skin_punctures <= 1"},
                                   {"posterior_wall <= 0", "nogo_length_critical <= 0"}),
                           {metrics, "", {}});
  std::vector<std::string> order;
  for (const CriterionResult& one : made.criteria) order.push_back(one.criterion.metric);
  EXPECT_EQ(order, (std::vector<std::string>{"nogo_length_critical", "posterior_wall", "skin_punctures",
                                             "blind_advance_max", "hit"}));
  EXPECT_EQ(made.critical_errors(), 1U);
}

TEST(GradeTest, ATimeLimitIsACriterionOfItsOwn) {
  const PassRule rule = rule_of({"hit >= 1"}, {});
  for (const auto& [time_s, verdict] : {std::pair{60.0, Verdict::passed}, std::pair{60.001, Verdict::failed}}) {
    std::vector<MetricValue> metrics = good_quality();
    metrics.push_back({"hit", in_force("hit"), 1.0, "bool", ""});
    metrics.push_back({"time_total", find_metric("time_total")->version, time_s, "s", ""});
    EXPECT_EQ(grade(rule, {metrics, "", 60.0}).verdict, verdict) << time_s;
    EXPECT_EQ(grade(rule, {metrics, "", {}}).verdict, Verdict::passed);
    metrics.push_back({"time_total", 99, 61.0, "s", ""});
    EXPECT_EQ(grade(rule, {metrics, "", 60.0}).verdict, Verdict::failed) << "the newest definition that is stored";
  }
  std::vector<MetricValue> metrics = good_quality();
  metrics.push_back({"hit", in_force("hit"), 1.0, "bool", ""});
  const Grade untimed = grade(rule, {metrics, "", 60.0});
  EXPECT_EQ(untimed.verdict, Verdict::failed) << "a time that is not known is not within the limit";
  EXPECT_TRUE(untimed.criteria[0].of_the_time_limit);
}

TEST(GradeTest, WithoutARuleThereIsNoGrade) {
  std::vector<MetricValue> metrics = good_quality();
  EXPECT_EQ(grade({}, {metrics, "", {}}).verdict, Verdict::no_rule);
  EXPECT_EQ(grade({}, {metrics, "", 60.0}).verdict, Verdict::no_rule) << "time only limits";
  EXPECT_EQ(grade({}, {metrics, "interrupted", {}}).reason, "interrupted");
}

TEST(GradeTest, WhatIsNotGradableIsNeitherPassedNorFailed) {
  const PassRule rule = rule_of({"hit >= 1"}, {});
  for (const double hit : {0.0, 1.0}) {
    std::vector<MetricValue> metrics = good_quality();
    metrics.push_back({"hit", in_force("hit"), hit, "bool", ""});
    for (const char* cut_off : {"interrupted", "device_lost"}) {
      const Grade made = grade(rule, {metrics, cut_off, {}});
      EXPECT_EQ(made.verdict, Verdict::not_gradable);
      EXPECT_EQ(made.reason, cut_off);
    }
    metrics[0].value = 0.06;  // gap_share
    EXPECT_EQ(grade(rule, {metrics, "", {}}).verdict, Verdict::not_gradable);
    EXPECT_EQ(grade(rule, {metrics, "", {}}).reason, "tracking_gaps");
    EXPECT_EQ(grade(rule, {{}, "", {}}).reason, "quality_not_measured");
  }
}

}  // namespace
}  // namespace seldinger::assessment
