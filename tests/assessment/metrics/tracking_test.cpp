// What no hand does is the tracker's: told before it is repaired, repaired where it can be, and a real hand is none
// of it. "Before" is what the version before said.
#include "assessment/signals/tracking.h"

#include "assessment/metrics/quality.h"
#include "tests/assessment/metrics/planted_attempts.h"

namespace seldinger::assessment {
namespace {

std::string not_graded(const cases::Recording& recording) {
  const auto signals = make_signals(planted_setting(), recording);
  EXPECT_TRUE(signals.has_value());
  return signals ? why_not_gradable(measure_all(*signals)) : "refused";
}

cases::Recording steady() {
  return straight_down([](double t_s) { return -20.0 + 10.0 * t_s; }, 8.0);
}

TEST(TrackingJumps, ALeapThatStaysIsOneAndIsNotBridged) {
  for (const double leap_mm : {12.0, 25.0, 80.0}) {
    auto recording = steady();
    for (auto& pose : recording.poses)
      if (pose.t_s > 4.005) pose.tip_lps_mm.x += leap_mm;
    recording.endpoint->tip_lps_mm = recording.poses.back().tip_lps_mm;
    EXPECT_EQ(planted_number(recording, "tracking_jumps"), 1.0) << leap_mm;  // before: 0
    EXPECT_EQ(planted_number(recording, "jumps_unrepaired"), 1.0) << leap_mm;
    EXPECT_EQ(planted_number(recording, "repaired_share"), 0.0) << leap_mm;
    EXPECT_EQ(not_graded(recording), "tracking_jumps") << leap_mm;             // before: graded
    EXPECT_NEAR(planted_number(recording, "path_tip"), 80.0, 0.5) << leap_mm;  // before, of 80 mm: 171
  }
}

TEST(TrackingJumps, LonePosesFarAwayAreRepaired) {
  const auto clean = steady();
  for (const double far_mm : {12.0, 20.0, 500.0}) {
    auto recording = clean;
    for (const std::size_t at : {201U, 350U, 351U, 600U}) recording.poses[at].tip_lps_mm.z += far_mm;
    EXPECT_EQ(planted_number(recording, "tracking_jumps"), 3.0) << far_mm;  // before, of 20 mm: 0
    EXPECT_EQ(planted_number(recording, "jumps_unrepaired"), 0.0) << far_mm;
    EXPECT_NEAR(planted_number(recording, "repaired_share"), 4.0 / 801.0, 1e-12) << far_mm;
    EXPECT_EQ(planted_number(recording, "gap_share"), 0.0) << far_mm;
    EXPECT_EQ(not_graded(recording), "") << far_mm;
    for (const char* id : {"path_tip", "path_in_tissue", "swept_area", "closest_approach", "skin_punctures"})
      EXPECT_NEAR(planted_number(recording, id), planted_number(clean, id), 1e-6) << id << ", " << far_mm;
  }
}

TEST(TrackingJumps, OverAHundredthRepairedIsNotGraded) {
  auto recording = steady();
  for (std::size_t at = 20; at < 780; at += 100) recording.poses[at].tip_lps_mm.z += 20.0;
  EXPECT_EQ(not_graded(recording), "") << "8 of 801";
  for (std::size_t at = 70; at < 780; at += 300) recording.poses[at].tip_lps_mm.z += 20.0;
  EXPECT_EQ(not_graded(recording), "tracking_repaired") << "11 of 801";
}

TEST(TrackingJumps, AHandIsNone) {
  // A reach of 0.4 m in 0.5 s; a stab of 30 mm in 0.15 s; a tremor of 2 mm at 8 Hz; a tracker's noise.
  const std::function<double(double)> ways[] = {
      [](double t_s) {
        const double s = std::clamp((t_s - 1.0) / 0.5, 0.0, 1.0);
        return -420.0 + 400.0 * s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
      },
      [](double t_s) {
        const double s = std::clamp((t_s - 1.0) / 0.15, 0.0, 1.0);
        return 10.0 + 30.0 * s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
      },
      [](double t_s) { return 30.0 + 2.0 * std::sin(2.0 * std::numbers::pi * 8.0 * t_s); }};
  for (const auto& way : ways)
    for (const double rate_hz : {60.0, 100.0, 200.0, 1000.0}) {
      auto recording = recorded(
          [&](double t_s, cases::PoseSample& pose) {
            pose.tip_lps_mm = {0.0, way(t_s), 0.0};
          },
          3.0, rate_hz);
      add_noise(recording, 0.05, 7);
      EXPECT_EQ(planted_number(recording, "tracking_jumps"), 0.0) << rate_hz;
      EXPECT_EQ(planted_number(recording, "repaired_share"), 0.0) << rate_hz;
    }
}

// A core needle's throw begins with the endpoint, and the way ends there.
TEST(TrackingJumps, ACoreNeedlesThrowIsNone) {
  auto recording = steady();
  recording.endpoint->t_s = 6.0;
  recording.endpoint->tip_lps_mm = {0.0, 40.0, 0.0};
  for (auto& pose : recording.poses)
    if (pose.t_s > 6.0) pose.tip_lps_mm.y += 22.0;
  AttemptSetting core = planted_setting();
  core.instrument.kind = cases::InstrumentKind::core;
  EXPECT_EQ(planted_number(recording, "tracking_jumps", core), 0.0);
}

TEST(TrackingJumps, TheProbesAreNone) {
  auto recording = steady();
  for (auto& pose : recording.poses)
    if (pose.t_s > 4.005) pose.probe_origin_lps_mm.x += 200.0;
  EXPECT_EQ(planted_number(recording, "tracking_jumps"), 0.0);
}

TEST(TrackingJumps, TheProgramsOwnMovesAreMarked) {
  auto recording = steady();
  for (auto& pose : recording.poses) {
    if (pose.t_s > 0.035) pose.tip_lps_mm.x += 120.0;  // from where the program put it to where the hand has it
    if (pose.t_s > 4.005) pose.tip_lps_mm.x -= 60.0;   // taken up again
  }
  recording.endpoint->tip_lps_mm = recording.poses.back().tip_lps_mm;
  recording.events = {{4.0, cases::EventKind::resumed}};
  EXPECT_EQ(planted_number(recording, "tracking_jumps"), 0.0);
  EXPECT_EQ(planted_number(recording, "gap_share"), 0.0);
  EXPECT_EQ(not_graded(recording), "");
  EXPECT_NEAR(planted_number(recording, "path_tip"), 80.0, 0.5) << "nor are they the hand's way";  // before: 260
  recording.events = {{4.0, cases::EventKind::needle_by_gamepad}};
  EXPECT_EQ(planted_number(recording, "tracking_jumps"), 0.0) << "hands changed";
  recording.events = {{3.0, cases::EventKind::guide_on}, {4.2, cases::EventKind::guide_reached}};
  EXPECT_EQ(planted_number(recording, "tracking_jumps"), 0.0) << "brought to its guide";
  recording.events->clear();
  EXPECT_EQ(planted_number(recording, "tracking_jumps"), 1.0) << "what nobody marked is one";
}

// What was stored before anything was repaired is graded as it was.
TEST(TrackingJumps, OldValuesAreJudgedAsBefore) {
  const auto stored = [](double jumps) {
    return why_not_gradable(std::vector<MetricValue>{{"gap_share", 2, 0.0, "share", ""},
                                                     {"sample_rate_p5", 1, 100.0, "Hz", ""},
                                                     {"tracking_jumps", 1, jumps, "count", ""}});
  };
  EXPECT_EQ(stored(0.0), "");
  EXPECT_EQ(stored(1.0), "tracking_jumps");
  // Of a recording that was measured again, the newest counts.
  std::vector<MetricValue> both = {
      {"gap_share", 2, 0.0, "share", ""},      {"gap_share", 3, 0.0, "share", ""},
      {"sample_rate_p5", 1, 100.0, "Hz", ""},  {"tracking_jumps", 1, 0.0, "count", ""},
      {"tracking_jumps", 2, 1.0, "count", ""}, {"jumps_unrepaired", 1, 1.0, "count", ""},
      {"repaired_share", 1, 0.0, "share", ""}};
  EXPECT_EQ(why_not_gradable(both), "tracking_jumps");
}

}  // namespace
}  // namespace seldinger::assessment
