// How the target was come to: of the last 20 mm, not of the time.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "assessment/registry.h"
#include "assessment/signals/signals.h"
#include "tests/assessment/metrics/flat_body.h"

namespace seldinger::assessment {
namespace {

// The needle goes straight down, 100 poses and pictures a second.
cases::Recording straight(const std::function<double(double)>& depth_mm, double seconds,
                          const std::function<bool(double)>& joint) {
  cases::Recording recording;
  for (int i = 0; i <= static_cast<int>(std::lround(100.0 * seconds)); ++i) {
    cases::PoseSample pose;
    pose.t_s = i / 100.0;
    pose.tip_lps_mm = {0.0, depth_mm(pose.t_s), 0.0};
    pose.needle_direction = {0.0, 1.0, 0.0};
    recording.poses.push_back(pose);
    recording.frames.push_back({pose.t_s, true, joint(pose.t_s), joint(pose.t_s), 10.0});
  }
  recording.endpoint =
      cases::Endpoint{recording.poses.back().t_s, recording.poses.back().tip_lps_mm, {0.0, 1.0, 0.0}};
  return recording;
}

MetricValue value(const cases::Recording& recording, const std::string& id = "advance_joint_visible_last_20_mm",
                  cases::Approach approach = cases::Approach::in_plane) {
  AttemptSetting setting;
  setting.approach = approach;
  setting.skin = &body();
  setting.target = cases::Lesion{{0.0, 60.0, 0.0}, 6.0, 20.0};
  const auto signals = make_signals(setting, recording);
  EXPECT_TRUE(signals.has_value());
  for (const MetricValue& metric : measure_all(*signals))
    if (metric.id == id) return metric;
  ADD_FAILURE() << id;
  return {};
}

constexpr double kTolerance = 0.01;  // a step of the way between two pictures

TEST(AdvanceJointVisibleLast, ParkingInViewAddsNothing) {
  // 60 mm unseen at 10 mm/s, then parked in view for 20 s before the shot: drill 1 was passed so.
  const auto parked =
      straight([](double t) { return std::min(60.0, 10.0 * t); }, 26.0, [](double t) { return t >= 6.01; });
  EXPECT_GT(*value(parked, "vis_joint").value, 0.7);  // before: share of time, asked for was 0.5
  EXPECT_NEAR(*value(parked).value, 0.0, kTolerance);
}

TEST(AdvanceJointVisibleLast, IsOfTheLastTwentyMillimetres) {
  // Seen in the first 40 mm and the last 5.
  const auto recording =
      straight([](double t) { return 10.0 * t; }, 6.0, [](double t) { return t < 4.0 || t >= 5.5; });
  EXPECT_NEAR(*value(recording).value, 0.25, kTolerance);
  auto frozen = recording;
  for (auto& frame : frozen.frames) frame.live = false;
  EXPECT_EQ(*value(frozen).value, 0.0) << "a frozen picture shows nothing";
  auto target_only = recording;
  for (auto& frame : target_only.frames) frame.needle_tip = false;
  EXPECT_EQ(*value(target_only).value, 0.0) << "tip and target at once";
  // A way that is shorter counts whole.
  EXPECT_NEAR(*value(straight([](double t) { return 10.0 * t; }, 1.0, [](double t) { return t < 0.3; })).value, 0.3,
              0.02);
}

TEST(AdvanceJointVisibleLast, ToAndFroInViewAddsNothing) {
  // 60 mm unseen, then five times 3 mm back and forth in view: no more than those 3 mm were seen.
  const auto jiggled = straight(
      [](double t) { return t < 6.0 ? 10.0 * t : 60.0 - 3.0 * std::abs(std::sin((t - 6.0) * 3.14159265358979)); },
      11.0, [](double t) { return t >= 6.0; });
  EXPECT_LT(*value(jiggled).value, 3.1 / 20.0);
}

TEST(AdvanceJointVisibleLast, ComingAgainInViewMendsIt) {
  // 60 mm unseen, back to 30, and on in view; then the same the other way round.
  const auto way = [](double t) {
    return t < 6.0 ? 10.0 * t : t < 9.0 ? 60.0 - 10.0 * (t - 6.0) : 30.0 + 10.0 * (t - 9.0);
  };
  EXPECT_NEAR(*value(straight(way, 12.0, [](double t) { return t >= 9.0; })).value, 1.0, kTolerance);
  EXPECT_NEAR(*value(straight(way, 12.0, [](double t) { return t < 9.0; })).value, 0.0, kTolerance);
}

TEST(AdvanceJointVisibleLast, WithoutAnEndpointOrAnAdvanceThereIsNone) {
  auto recording = straight([](double t) { return 10.0 * t; }, 6.0, [](double) { return true; });
  recording.endpoint.reset();
  EXPECT_EQ(value(recording).reason, "no_endpoint");
  EXPECT_EQ(value(straight([](double) { return -20.0; }, 3.0, [](double) { return true; })).reason,
            "never_in_tissue");
  EXPECT_EQ(value(straight([](double) { return 30.0; }, 3.0, [](double) { return true; })).reason,
            "under_1_mm_of_advance");
}

TEST(AdvanceBetweenSights, OfAProbeThatWaitsAtTheTargetIsTheWholeWay) {
  const auto longest = [](const std::function<bool(double)>& seen) {
    return *value(straight([](double t) { return std::min(40.0, 10.0 * t); }, 8.0, seen),
                  "longest_advance_between_sights", cases::Approach::out_of_plane)
                .value;
  };
  // Drill 3 was passed so: 40 mm unseen, nothing beyond a plane that the tip comes to last.
  EXPECT_NEAR(longest([](double t) { return t >= 4.0; }), 40.0, 0.2);
  // A glimpse every 5 mm.
  EXPECT_NEAR(longest([](double t) { return std::fmod(t + 1e-9, 0.5) < 0.035; }), 5.0, 0.4);
  EXPECT_EQ(longest([](double) { return true; }), 0.0);
  EXPECT_EQ(value(straight([](double t) { return 10.0 * t; }, 2.0, [](double) { return true; }),
                  "longest_advance_between_sights")
                .reason,
            "not_meaningful_in_plane");
}

TEST(AdvanceBetweenSights, APictureInAGapEndsNone) {
  // 4 mm, 0.5 s of gap, 4 mm; the tip is shown within the gap, or until it is over.
  const auto longest = [](double shown_until_s) {
    auto recording =
        straight([](double t) { return 20.0 + 10.0 * (std::min(t, 0.4) + std::clamp(t - 1.0, 0.0, 0.4)); }, 1.5,
                 [=](double t) { return t > 0.495 && t < shown_until_s; });
    std::erase_if(recording.poses, [](const auto& pose) { return pose.t_s > 0.405 && pose.t_s < 0.895; });
    return *value(recording, "longest_advance_between_sights", cases::Approach::out_of_plane).value;
  };
  EXPECT_NEAR(longest(0.7), 8.0, 1e-6);  // before: 4
  EXPECT_NEAR(longest(0.935), 4.0, 1e-6) << "and when it was over";
}

}  // namespace
}  // namespace seldinger::assessment
