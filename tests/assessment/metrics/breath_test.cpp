// Tests of assessment/metrics/breath and assessment/signals/breath_holds: closed forms and edge rules.
#include "assessment/signals/breath_holds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "assessment/registry.h"
#include "assessment/signals/signals.h"
#include "tests/assessment/metrics/flat_body.h"

namespace seldinger::assessment {
namespace {

using cases::EventKind;

// The body with an organ from 40 mm on; the target's middle is 60 mm deep.
struct Breathing {
  std::vector<cases::Structure> organ = {
      {"liver", volume::TissueClass::soft_tissue, cases::StructureRule::organ, cases::Sphere{{0, 90, 0}, 50.0}}};
  AttemptSetting setting() const {
    AttemptSetting made;
    made.skin = &body();
    made.target = cases::Lesion{{0.0, 60.0, 0.0}, 6.0, 20.0};
    made.structures = organ;
    made.breathes = true;
    return made;
  }
};

// Straight down by 10 mm/s from the skin to 60 mm at 6 s, where it is fired; the tissue at the tip is `rest_mm`
// deeper, or not, by then.
cases::Recording pushed(std::vector<cases::Event> events, const std::function<double(double)>& rest_mm = {}) {
  cases::Recording recording;
  for (int i = -50; i <= 600; ++i) {
    cases::PoseSample pose;
    pose.t_s = i / 100.0;
    pose.tip_lps_mm = {0.0, pose.t_s * 10.0, 0.0};
    pose.needle_direction = {0.0, 1.0, 0.0};
    if (rest_mm) pose.rest_tip_lps_mm = pose.tip_lps_mm + glm::dvec3(0.0, rest_mm(pose.t_s), 0.0);
    recording.poses.push_back(pose);
    recording.frames.push_back({pose.t_s, true, true, true, 10.0});
  }
  const cases::PoseSample& last = recording.poses.back();
  recording.endpoint = cases::Endpoint{last.t_s, last.tip_lps_mm, last.needle_direction, last.rest_tip_lps_mm};
  recording.events = std::move(events);
  return recording;
}

MetricValue value(const AttemptSetting& setting, const cases::Recording& recording, const std::string& id) {
  const auto signals = make_signals(setting, recording);
  EXPECT_TRUE(signals.has_value());
  if (signals)
    for (const MetricValue& metric : measure_all(*signals))
      if (metric.id == id) return metric;
  ADD_FAILURE() << id;
  return {};
}
double number(const AttemptSetting& setting, const cases::Recording& recording, const std::string& id) {
  return value(setting, recording, id).value.value_or(std::nan(""));
}

TEST(Breath, IsHeldFromGrantToLossOrRelease) {
  const Breathing body;
  const auto holds = [&](std::vector<cases::Event> events) {
    return breath_holds(*make_signals(body.setting(), pushed(std::move(events))));
  };
  EXPECT_TRUE(holds({}).empty());
  EXPECT_TRUE(holds({{1.0, EventKind::breath_hold_request}}).empty()) << "asked for is not held";
  const auto two = holds({{1.0, EventKind::breath_held},
                          {2.0, EventKind::breath_lost},
                          {3.0, EventKind::breath_held},
                          {3.5, EventKind::breathe_again},
                          {3.6, EventKind::breath_lost}});
  ASSERT_EQ(two.size(), 2U);
  EXPECT_EQ(two[0].from_s, 1.0);
  EXPECT_EQ(two[0].to_s, 2.0);
  EXPECT_TRUE(two[0].lost);
  EXPECT_FALSE(two[1].lost);
  const auto open = holds({{5.0, EventKind::breath_held}, {9.0, EventKind::breath_lost}});
  ASSERT_EQ(open.size(), 1U);
  EXPECT_EQ(open[0].to_s, 6.0) << "at most to the endpoint";
  EXPECT_FALSE(open[0].lost) << "not by then";
  EXPECT_TRUE(holds({{6.0, EventKind::breath_held}, {6.5, EventKind::breathe_again}}).empty());
}

TEST(Breath, AdvanceIsCountedInTheOrgan) {
  const Breathing body;
  // In the organ from 4 s on: 20 mm, of which breath is held for 0.5 s and for 1 s.
  const auto recording = pushed({{1.0, EventKind::breath_hold_request},
                                 {2.0, EventKind::breath_held},
                                 {4.5, EventKind::breath_lost},
                                 {4.6, EventKind::breath_hold_request},
                                 {5.0, EventKind::breath_held}});
  EXPECT_NEAR(number(body.setting(), recording, "advance_breath_held_share"), 15.0 / 20.0, 0.01);
  EXPECT_NEAR(number(body.setting(), recording, "advance_in_breath"), 5.0, 0.11);
  EXPECT_EQ(number(body.setting(), recording, "fired_breath_held"), 1.0);
  EXPECT_NEAR(number(body.setting(), recording, "breath_hold_time"), 3.5, 1e-9);
  EXPECT_NEAR(number(body.setting(), recording, "breath_hold_used"), 1.0, 0.01) << "it advanced all the while";
  EXPECT_EQ(number(body.setting(), recording, "breath_holds_asked"), 2.0);
  EXPECT_EQ(number(body.setting(), recording, "breath_holds_failed"), 1.0);

  AttemptSetting unmarked = body.setting();
  unmarked.structures = {};
  // From 20 mm before the target's edge at 54 mm: 26 mm, of which 15 and 10.
  EXPECT_NEAR(number(unmarked, recording, "advance_breath_held_share"), (11.0 + 10.0) / 26.0, 0.01);
}

TEST(Breath, WhatIsNotUsedIsTold) {
  const Breathing body;
  cases::Recording recording = pushed({{2.0, EventKind::breath_held}, {5.0, EventKind::breathe_again}});
  for (cases::PoseSample& pose : recording.poses)  // rests from 3 s to 5 s
    if (pose.t_s > 3.0) pose.tip_lps_mm.y = std::max(30.0, 30.0 + (pose.t_s - 5.0) * 30.0);
  EXPECT_NEAR(number(body.setting(), recording, "breath_hold_used"), 1.0 / 3.0, 0.01);
  EXPECT_EQ(number(body.setting(), recording, "fired_breath_held"), 0.0);
  EXPECT_EQ(number(body.setting(), recording, "breath_holds_failed"), 0.0) << "given back";
}

TEST(Breath, WhatBreathDoesIsNoAdvanceOfTheHand) {
  const Breathing body;
  // The hand rests 45 mm deep from 4.5 s on; the tissue goes to and fro under it by 8 mm.
  cases::Recording recording = pushed({}, [](double t_s) { return 8.0 * std::sin(2.0 * t_s); });
  const auto rest_mm = [](double t_s) { return 8.0 * std::sin(2.0 * t_s); };
  for (cases::PoseSample& pose : recording.poses)
    if (pose.t_s > 4.5) {
      pose.tip_lps_mm.y = 45.0;
      pose.rest_tip_lps_mm = glm::dvec3(0.0, 45.0 + rest_mm(pose.t_s), 0.0);
    }
  recording.endpoint.reset();
  const double advanced_mm = number(body.setting(), recording, "advance_in_breath");
  // From where the tissue at the tip is the organ, with the hand at 34.8 mm (1: 10.2 mm, of the hand alone): no
  // less than the lesser of hand and tissue at each moment, no more than what it came on in the tissue.
  EXPECT_GT(advanced_mm, 6.1);
  EXPECT_LT(advanced_mm, 8.3);
  // The same with the tissue still: not more than the hand went.
  for (cases::PoseSample& pose : recording.poses) pose.rest_tip_lps_mm.reset();
  EXPECT_NEAR(number(body.setting(), recording, "advance_in_breath"), 5.0, 0.11);
}

TEST(Breath, ANeedleThatGoesAlongWithTheTissueIsNotPushedOn) {
  // Rests 50 mm deep in the tissue from 5 s on, and breath takes both to and fro by 6 mm.
  const Breathing body;
  cases::Recording rides;
  for (int i = -50; i <= 2000; ++i) {
    cases::PoseSample pose;
    pose.t_s = i / 100.0;
    pose.rest_tip_lps_mm = glm::dvec3(0.0, std::min(50.0, 10.0 * pose.t_s), 0.0);
    pose.tip_lps_mm = *pose.rest_tip_lps_mm;
    pose.tip_lps_mm.y += pose.t_s < 5.0 ? 0.0 : 3.0 - 3.0 * std::cos(1.5 * (pose.t_s - 5.0));
    pose.needle_direction = {0.0, 1.0, 0.0};
    rides.poses.push_back(pose);
    rides.frames.push_back({pose.t_s, true, true, true, 10.0});
  }
  rides.events = {{1.0, EventKind::breath_held}, {5.0, EventKind::breathe_again}};
  EXPECT_NEAR(number(body.setting(), rides, "advance_in_breath"), 0.0, 0.3);           // 1: over 15
  EXPECT_NEAR(number(body.setting(), rides, "advance_breath_held_share"), 1.0, 0.03);  // 1: under 0.4
}

TEST(Breath, OfWhoLiesStillNothingIsTold) {
  const Breathing body;
  AttemptSetting still = body.setting();
  still.breathes = false;
  int told = 0;
  for (const MetricInfo& info : registry()) {
    if ((info.needs & kBreathes) == 0) continue;
    ++told;
    const MetricValue metric = value(still, pushed({{2.0, EventKind::breath_held}}), info.id);
    EXPECT_FALSE(metric.value.has_value()) << info.id;
    EXPECT_EQ(metric.reason, "patient_lies_still") << info.id;
  }
  EXPECT_EQ(told, 7);
  EXPECT_TRUE(absent_from_case("patient_lies_still"));
  // Nor of who was not listened to, or never held it.
  cases::Recording deaf = pushed({});
  EXPECT_EQ(value(body.setting(), deaf, "breath_hold_used").reason, "breath_never_held");
  EXPECT_EQ(number(body.setting(), deaf, "breath_hold_time"), 0.0);
  EXPECT_EQ(number(body.setting(), deaf, "advance_breath_held_share"), 0.0);
  deaf.events.reset();
  EXPECT_EQ(value(body.setting(), deaf, "breath_hold_time").reason, "events_not_recorded");
  cases::Recording unfired = pushed({});
  unfired.endpoint.reset();
  EXPECT_EQ(value(body.setting(), unfired, "fired_breath_held").reason, "no_endpoint");
  cases::Recording outside = pushed({});
  for (cases::PoseSample& pose : outside.poses) pose.tip_lps_mm.y = -20.0;
  outside.endpoint.reset();
  EXPECT_EQ(value(body.setting(), outside, "advance_breath_held_share").reason, "under_1_mm_of_advance");
}

}  // namespace
}  // namespace seldinger::assessment
