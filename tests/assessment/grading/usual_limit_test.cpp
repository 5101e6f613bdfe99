// What a criterion asks for at first can be met: by itself, and beside the hit that nearly every rule asks for.
#include "assessment/grading/usual_limit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "assessment/grading/contradictions.h"
#include "assessment/registry.h"

namespace seldinger::assessment {
namespace {

TEST(UsualLimitTest, IsMetBesideAHit) {
  for (const MetricInfo& info : registry()) {
    PassRule rule;
    rule.criteria = {usual_criterion(info), *criterion_from("hit >= 1")};
    const Criterion& usual = rule.criteria.front();
    EXPECT_EQ(usual.metric, info.id);
    EXPECT_EQ(usual.version, info.version);
    EXPECT_TRUE(std::isfinite(usual.value)) << info.id;
    for (const base::Problem& one : contradictions_of(rule, {})) ADD_FAILURE() << info.id << ": " << one.text;
    const bool lower = info.direction == Direction::lower_is_better,
               higher = info.direction == Direction::higher_is_better;
    EXPECT_FALSE(lower && usual.comparison != Comparison::at_most) << info.id;
    EXPECT_FALSE(higher && usual.comparison != Comparison::at_least) << info.id;
  }
}

// Was: none, with which nobody hits anything.
TEST(UsualLimitTest, AllowsTheHoleThatAHitNeeds) {
  EXPECT_EQ(text_of(usual_criterion(*find_metric("skin_punctures"))), "skin_punctures <= 1");
  EXPECT_EQ(text_of(usual_criterion(*find_metric("nogo_length_critical"))), "nogo_length_critical <= 0");
  EXPECT_EQ(text_of(usual_criterion(*find_metric("vis_joint"))), "vis_joint >= 0.8");
}

}  // namespace
}  // namespace seldinger::assessment
