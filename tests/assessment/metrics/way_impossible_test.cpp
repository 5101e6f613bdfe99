// A needle that no hand can lead there hits nothing and is not graded.
#include <gtest/gtest.h>

#include <functional>
#include <glm/geometric.hpp>

#include "assessment/metrics/quality.h"
#include "tests/assessment/metrics/straight_attempts.h"

namespace seldinger::assessment {
namespace {

// 100 mm a side; the ends along z are caps.
const cases::MeshIndex& capped_box() {
  static const cases::MeshIndex index(fixtures::box_mesh({-50, 0, -50}, {50, 100, 50}, true));
  return index;
}

AttemptSetting in_the_box() {
  AttemptSetting made = setting();
  made.skin = &capped_box();
  made.target = cases::Lesion{{0.0, 50.0, 0.0}, 6.0};
  made.table_mm = -100.0;  // up is −y, supine
  return made;
}

// From 30 mm before `entry` along `direction` at 20 mm/s to a depth, and there the trigger.
cases::Recording along(const glm::dvec3& entry, const glm::dvec3& direction, double depth_mm) {
  cases::Recording made;
  for (int i = 0; i * 0.2 <= 30.0 + depth_mm; ++i) {
    cases::PoseSample pose;
    pose.t_s = i * 0.01;
    pose.tip_lps_mm = entry + direction * (i * 0.2 - 30.0);
    pose.needle_direction = direction;
    made.poses.push_back(pose);
    made.frames.push_back({pose.t_s, true, true, true, 10.0});
  }
  made.endpoint = cases::Endpoint{made.poses.back().t_s, made.poses.back().tip_lps_mm, direction};
  return made;
}

struct Judged {
  double hit, impossible;
  std::string why;
};

Judged judged(const cases::Recording& recording) {
  const auto signals = make_signals(in_the_box(), recording);
  EXPECT_TRUE(signals);
  return {number(recording, "hit", in_the_box()), number(recording, "way_impossible", in_the_box()),
          why_not_gradable(measure_all(*signals))};
}

TEST(WayImpossible, ThroughSkinAWayIsPossible) {
  const Judged front = judged(along({0, 0, 0}, {0, 1, 0}, 50.0));
  EXPECT_EQ(front.hit, 1.0);
  EXPECT_EQ(front.impossible, 0.0);
  EXPECT_EQ(front.why, "");
}

TEST(WayImpossible, ThroughACapTheTargetIsNotHitAndNothingIsGraded) {
  const Judged cap = judged(along({0, 50, -50}, {0, 0, 1}, 50.0));
  EXPECT_EQ(cap.hit, 0.0);
  EXPECT_EQ(cap.impossible, 1.0);
  EXPECT_EQ(cap.why, "way_impossible");
  // Drawn out at once, it was there none the less.
  cases::Recording back = along({0, 50, -50}, {0, 0, 1}, 10.0);
  const std::size_t in = back.poses.size();
  for (std::size_t i = 0; i < in; ++i) {
    cases::PoseSample pose;
    pose.t_s = back.poses[in - 1].t_s + 0.01 * static_cast<double>(i + 1);
    pose.tip_lps_mm = back.poses[in - 1 - i].tip_lps_mm;
    pose.needle_direction = {0.0, 0.0, 1.0};
    back.poses.push_back(pose);
  }
  back.endpoint.reset();
  EXPECT_EQ(number(back, "way_impossible", in_the_box()), 1.0);
}

TEST(WayImpossible, OutOfACapAheadIsPastACutToo) {
  EXPECT_EQ(judged(along({0, 0, 0}, glm::normalize(glm::dvec3(0, 0.6, 0.8)), 75.0)).impossible, 1.0);
  EXPECT_EQ(judged(along({0, 0, 0}, glm::normalize(glm::dvec3(0, 0.6, 0.8)), 55.0)).impossible, 0.0);
}

TEST(WayImpossible, OutOnTheOtherSideIsNoWay) {
  const glm::dvec3 slanting = glm::normalize(glm::dvec3(1, 1, 0));
  EXPECT_EQ(judged(along({20, 0, 0}, slanting, 40.0)).impossible, 0.0);
  const Judged out = judged(along({20, 0, 0}, slanting, 50.0));  // 42.4 mm to the side
  EXPECT_EQ(out.hit, 0.0);
  EXPECT_EQ(out.impossible, 1.0);
}

TEST(WayImpossible, FromUnderTheTableIsNoWayAndFromTheSideIs) {
  EXPECT_EQ(judged(along({0, 100, 0}, {0, -1, 0}, 50.0)).impossible, 1.0);
  EXPECT_EQ(judged(along({50, 50, 0}, {-1, 0, 0}, 50.0)).impossible, 0.0);
}

TEST(WayImpossible, WhatBeginsInTheBodyShowsNoPuncture) {
  const auto from = [](double depth_mm) {
    cases::Recording made = along({0, 0, 0}, {0, 1, 0}, 50.0);
    std::erase_if(made.poses, [&](const cases::PoseSample& pose) { return pose.tip_lps_mm.y < depth_mm; });
    std::erase_if(made.frames, [&](const auto& frame) { return frame.t_s < made.poses.front().t_s; });
    return judged(made);
  };
  const Judged touching = from(1.0), inside = from(10.0);
  EXPECT_EQ(touching.impossible, 0.0);
  EXPECT_EQ(touching.why, "");
  EXPECT_EQ(inside.impossible, 1.0);
  EXPECT_EQ(inside.why, "way_impossible");
}

TEST(WayImpossible, AnAttemptStoredBeforeItWasAskedKeepsItsGrade) {
  const auto signals = make_signals(in_the_box(), along({0, 50, -50}, {0, 0, 1}, 50.0));
  ASSERT_TRUE(signals);
  std::vector<MetricValue> metrics = measure_all(*signals);
  EXPECT_EQ(why_not_gradable(metrics), "way_impossible");
  std::erase_if(metrics, [](const MetricValue& metric) { return metric.id == "way_impossible"; });
  EXPECT_EQ(why_not_gradable(metrics), "");
}

}  // namespace
}  // namespace seldinger::assessment
