// What was seen of needle and target, over time and over the way, and how the needle lay to the picture.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/assessment/metrics/straight_attempts.h"

namespace seldinger::assessment {
namespace {

TEST(Visibility, SharesAreOfTheTimeInTissue) {
  auto recording = straight([](double t) { return t < 2.0 ? -5.0 : 30.0; }, 10.0);
  for (auto& frame : recording.frames) {
    frame.needle_tip = frame.t_s >= 2.0 && frame.t_s < 4.0;  // 2 of 8 s in tissue
    frame.target = frame.t_s < 7.0;                          // 5 of 8 s
  }
  EXPECT_NEAR(number(recording, "vis_needle"), 0.25, 1e-9);
  EXPECT_NEAR(number(recording, "vis_target"), 0.625, 1e-9);
  EXPECT_NEAR(number(recording, "vis_joint"), 0.25, 1e-9);
  for (auto& frame : recording.frames) frame.live = frame.t_s < 6.0;  // a frozen picture shows nothing
  EXPECT_NEAR(number(recording, "vis_needle"), 0.25, 1e-9);
  EXPECT_NEAR(number(recording, "vis_target"), 0.5, 1e-9);
}

TEST(Visibility, FramesHoldUntilTheNextAtAnyRate) {
  auto recording = straight([](double) { return 30.0; }, 10.0);
  recording.frames = {
      {0.0, true, true, true, 1.0}, {2.503, true, false, true, 1.0}, {9.001, true, true, false, 1.0}};
  EXPECT_NEAR(number(recording, "vis_needle"), 0.2503 + 0.0999, 1e-9);
  EXPECT_NEAR(number(recording, "vis_target"), 0.9001, 1e-9);
  EXPECT_NEAR(number(recording, "vis_joint"), 0.2503, 1e-9);
}

// What was told by the older law of sight stays of the version of that time, with the same value.
TEST(Visibility, OfTheOlderLawItIsTheVersionBefore) {
  const auto recording = straight([](double t) { return 10.0 * t; }, 5.0);
  const auto now = measure_all(*make_signals(setting(), recording));
  using Count = std::array<int, 5>;  // of metrics that are one, two, … and five versions before
  for (const auto& [law, expected] : {std::pair{cases::SightLaw::material, Count{11, 0, 0, 0, 0}},
                                      {cases::SightLaw::clutter, {7, 4, 0, 0, 0}},
                                      {cases::SightLaw::scatter, {0, 7, 4, 0, 0}},
                                      {cases::SightLaw::echo, {0, 7, 0, 4, 0}},
                                      {cases::SightLaw::half_slice, {2, 2, 5, 0, 4}}}) {
    AttemptSetting old = setting();
    old.sight_law = law;
    const auto then = measure_all(*make_signals(old, recording));
    ASSERT_EQ(now.size(), then.size());
    Count before{};
    for (std::size_t i = 0; i < now.size(); ++i) {
      const MetricInfo& info = *find_metric(now[i].id);
      EXPECT_EQ(now[i].version, info.version) << now[i].id;
      EXPECT_GE(then[i].version, 1) << now[i].id;
      EXPECT_EQ(then[i].value, now[i].value) << now[i].id;
      for (int k = 1; k <= 5; ++k) before[static_cast<std::size_t>(k - 1)] += then[i].version == info.version - k;
    }
    EXPECT_EQ(before, expected) << base::name_of(cases::kSightLawNames, law);
  }
}

TEST(Visibility, TooLittleTimeOutOfPlaneAndNoTargetAreNull) {
  EXPECT_EQ(value(straight([](double t) { return t < 2.0 ? -5.0 : 30.0; }, 2.9), "vis_needle").reason,
            "under_1_s_in_tissue");
  AttemptSetting s = setting();
  s.approach = cases::Approach::out_of_plane;
  const auto recording = straight([](double) { return 30.0; }, 5.0);
  EXPECT_EQ(value(recording, "vis_needle", s).reason, "not_meaningful_out_of_plane");
  EXPECT_EQ(value(recording, "vis_joint", s).reason, "not_meaningful_out_of_plane");
  EXPECT_TRUE(value(recording, "vis_target", s).value.has_value());
  s = setting();
  s.target.reset();
  EXPECT_EQ(value(recording, "vis_target", s).reason, "no_target");
  EXPECT_EQ(value(recording, "vis_joint", s).reason, "no_target");
}

TEST(Visibility, NearThePlaneIsOfUltrasoundThatWasRecordedSo) {
  auto recording = straight([](double) { return 30.0; }, 10.0);
  AttemptSetting s = setting();
  s.modality = cases::Modality::ultrasound;
  for (auto& frame : recording.frames)
    frame.near_plane = cases::NearPlane{frame.t_s < 2.0, frame.t_s >= 1.0, frame.t_s < 6.0, true};
  EXPECT_NEAR(number(recording, "vis_joint_2_mm", s), 0.1, 1e-9);
  EXPECT_NEAR(number(recording, "vis_joint_5_mm", s), 0.6, 1e-9);
  EXPECT_EQ(value(recording, "vis_joint_2_mm").reason, "not_ultrasound");
  EXPECT_FALSE(applies(value(recording, "vis_joint_2_mm"), manner_of(setting())));
  recording.frames[7].near_plane.reset();
  EXPECT_EQ(value(recording, "vis_joint_5_mm", s).reason, "near_plane_not_recorded");
  EXPECT_TRUE(applies(value(recording, "vis_joint_5_mm", s), manner_of(s)));
  s.approach = cases::Approach::out_of_plane;
  EXPECT_EQ(value(recording, "vis_joint_5_mm", s).reason, "not_meaningful_out_of_plane");
}

TEST(ChosenProbe, SuitsTheDepthAtWhichItLookedWhenTheSkinWasPunctured) {
  AttemptSetting s = setting();
  s.modality = cases::Modality::ultrasound;
  auto recording = straight([](double t_s) { return ramp(t_s, 20.0); }, 3.0);  // through the skin after 1 s
  EXPECT_EQ(value(recording, "probe_suits", s).reason, "probe_given");
  const auto suits = [&](double from_mm, double to_mm, double face_mm) {
    s.probe_suits = cases::DepthRange{from_mm, to_mm};
    // Before and after the puncture it is somewhere else.
    for (cases::PoseSample& pose : recording.poses) {
      pose.probe_axial = {0.0, 1.0, 0.0};
      pose.probe_origin_lps_mm = {70.0, pose.t_s > 0.9 && pose.t_s < 1.2 ? face_mm : -500.0, 0.0};
    }
    return number(recording, "probe_suits", s);
  };
  EXPECT_EQ(suits(0.0, 50.0, 0.0), 0.0) << "60 mm are too deep for a linear probe";
  EXPECT_EQ(suits(0.0, 50.0, 11.0), 1.0);
  EXPECT_EQ(suits(25.0, 300.0, 0.0), 1.0);
  EXPECT_EQ(suits(25.0, 300.0, 36.0), 0.0) << "24 mm are too near for a curved one";
  const std::string definition = find_metric("probe_suits")->definition;
  for (const double bound_mm : {cases::kLinearSuits.to_mm, cases::kCurvedSuits.from_mm})
    EXPECT_NE(definition.find(std::to_string(std::lround(bound_mm)) + " mm"), std::string::npos) << bound_mm;
  const auto beside = straight([](double) { return -10.0; }, 3.0);
  EXPECT_EQ(value(beside, "probe_suits", s).reason, "never_punctured");
  s.modality = cases::Modality::mpr;
  EXPECT_EQ(value(recording, "probe_suits", s).reason, "not_ultrasound");
}

TEST(Visibility, TheNeedlesLengthIsAMeanOverTheTime) {
  auto recording = straight([](double t) { return t < 2.0 ? -5.0 : 30.0; }, 10.0);
  for (auto& frame : recording.frames) frame.needle_length_mm = frame.t_s < 4.0 ? 40.0 : 8.0;
  EXPECT_NEAR(number(recording, "visible_needle_length"), (2.0 * 40.0 + 6.0 * 8.0) / 8.0, 1e-9);
}

TEST(Visibility, OfTheSessionCountsWhatIsOutsideTissueToo) {
  auto recording = straight(in_turn({{5.0, -5.0}, {99.0, 30.0}}), 10.0);
  for (auto& frame : recording.frames) frame.target = frame.t_s < 7.0;
  EXPECT_NEAR(number(recording, "vis_joint_session"), 0.7, 1e-9);
  EXPECT_NEAR(number(recording, "vis_joint"), 0.4, 0.003);
  for (auto& frame : recording.frames) frame.needle_length_mm = frame.t_s < 6.0 ? 3.0 : 0.0;
  EXPECT_NEAR(number(recording, "vis_shaft"), 0.2, 0.004);
}

TEST(BlindAdvance, IsWhatNobodySaw) {
  // 10 mm/s from the skin: seen from 1 to 2 s, and by one picture at 4 s, which is no sight (in version 1 it was
  // one).
  auto recording = straight([](double t) { return 10.0 * t; }, 6.0);
  for (auto& frame : recording.frames)
    frame.needle_tip = (frame.t_s >= 1.0 && frame.t_s < 2.0) || std::abs(frame.t_s - 4.0) < 0.005;
  EXPECT_NEAR(number(recording, "blind_advance"), 50.0 - 0.1, 1e-6);
  EXPECT_NEAR(number(recording, "blind_advance_max"), 40.0 - 0.1, 1e-6);
  EXPECT_NEAR(number(recording, "advance_visible_share"), 10.1 / 60.0, 1e-6);
  for (auto& frame : recording.frames) frame.live = false;
  EXPECT_NEAR(number(recording, "blind_advance_max"), 60.0, 1e-6) << "a frozen picture shows nothing";
  EXPECT_EQ(number(straight([](double) { return 20.0; }, 3.0), "blind_advance"), 0.0);
  EXPECT_EQ(value(straight([](double) { return -20.0; }, 3.0), "blind_advance").reason, "never_in_tissue");
}

TEST(PlaneAngle, IsAveragedOverTheWay) {
  // In plane for 10 mm, then at 30° to it for 20 mm; a rest counts nothing.
  auto recording =
      straight([](double t) { return t < 1.0   ? 10.0 * t
                                     : t < 5.0 ? 10.0
                                               : 10.0 + 10.0 * (t - 5.0); }, 7.0);
  for (auto& pose : recording.poses) {
    pose.probe_axial = {0.0, 1.0, 0.0};
    pose.probe_lateral = pose.t_s < 3.0 ? glm::dvec3(1, 0, 0) : glm::dvec3(std::cos(0.3), 0.0, std::sin(0.3));
    if (pose.t_s > 3.0) pose.probe_axial = {0.0, std::cos(std::numbers::pi / 6), std::sin(std::numbers::pi / 6)};
    if (pose.t_s > 3.0) pose.probe_lateral = {1.0, 0.0, 0.0};
  }
  EXPECT_NEAR(number(recording, "plane_angle_mean"), 20.0, 1e-6);
  EXPECT_NEAR(number(recording, "plane_angle_max"), 30.0, 1e-6);
  for (auto& pose : recording.poses) pose.probe_lateral = pose.probe_axial;
  EXPECT_EQ(value(recording, "plane_angle_mean").reason, "no_picture_plane");
}

// 0 before: an angle of the guide's was praised as the trainee's.
TEST(PlaneAngle, UnderANeedleGuideIsTheGuides) {
  using enum cases::EventKind;
  auto recording = straight([](double t) { return ramp(t, 20.0); }, 3.0);  // in tissue from 1 s on
  for (auto& pose : recording.poses) pose.probe_axial = {0.0, 1.0, 0.0};
  for (const char* id : {"plane_angle_mean", "plane_angle_max", "probe_drift_advancing"}) {
    recording.events.reset();
    EXPECT_EQ(number(recording, id), 0.0) << "nobody listened: as before";
    recording.events = {{0.1, sign_in}};
    EXPECT_EQ(number(recording, id), 0.0) << "whether there was a guide is not known: as before";
    recording.events = {{0.001, needle_by_mouse}, {0.2, guide_on}, {0.5, guide_reached}, {0.9, guide_off}};
    EXPECT_EQ(number(recording, id), 0.0) << "in the air it led nothing";
    recording.events = {{0.001, needle_by_mouse}, {0.2, guide_on}, {0.5, guide_reached}, {1.1, guide_off}};
    EXPECT_EQ(value(recording, id).reason, "needle_guide_was_on");
    recording.events = {{0.001, needle_by_mouse}, {0.2, guide_on}, {0.5, guide_reached}};
    EXPECT_EQ(value(recording, id).reason, "needle_guide_was_on");
  }
  EXPECT_EQ(number(recording, "advance_visible_share"), 1.0) << "what was looked at stays the trainee's";
  EXPECT_EQ(number(recording, "blind_advance"), 0.0);
}

TEST(AdvanceBeyondPlane, CountsFromThreeMillimetresOnTheFarSide) {
  AttemptSetting s = setting();
  s.modality = cases::Modality::ultrasound;
  s.approach = cases::Approach::out_of_plane;
  auto recording = straight([](double t) { return 10.0 * t; }, 5.0);
  for (auto& pose : recording.poses) {  // the plane lies across the needle, 30 mm deep
    pose.probe_origin_lps_mm = {0.0, 30.0, 0.0};
    pose.probe_axial = {0.0, 0.0, 1.0};
    pose.probe_lateral = {1.0, 0.0, 0.0};
  }
  EXPECT_NEAR(number(recording, "advance_beyond_plane", s), 17.0, 1e-6);
  for (auto& pose : recording.poses) pose.probe_lateral = -pose.probe_lateral;
  EXPECT_NEAR(number(recording, "advance_beyond_plane", s), 17.0, 1e-6) << "a plane has no side of its own";
  EXPECT_EQ(value(recording, "advance_beyond_plane").reason, "not_meaningful_in_plane");
  EXPECT_EQ(value(recording, "blind_advance", s).reason, "not_meaningful_out_of_plane");
  EXPECT_EQ(value(recording, "probe_drift_advancing", s).reason, "not_meaningful_out_of_plane");
}

TEST(AdvanceVisibleShare, CountsWayNotTime) {
  // 20 mm seen, parked in view for long, 30 mm unseen.
  auto recording =
      straight([](double t) { return t < 2.0   ? 10.0 * t
                                     : t < 8.0 ? 20.0
                                               : 20.0 + 15.0 * (t - 8.0); }, 10.0);
  for (auto& frame : recording.frames) frame.needle_tip = frame.t_s < 8.0;
  EXPECT_NEAR(number(recording, "advance_visible_share"), 0.4, 1e-9);
  for (auto& frame : recording.frames) frame.live = frame.t_s < 1.0;
  EXPECT_NEAR(number(recording, "advance_visible_share"), 0.2, 1e-9) << "a frozen picture shows nothing";
}

TEST(AdvanceVisibleShare, WithdrawnWayCountsAgainAndJiggleDoesNot) {
  // Down 30, up 20, down 20, seen the second time only.
  auto recording = straight(
      [](double t) { return t < 3.0   ? 10.0 * t
                            : t < 5.0 ? 30.0 - 10.0 * (t - 3.0)
                                      : 10.0 + 10.0 * (t - 5.0); },
      7.0);
  for (auto& frame : recording.frames) frame.needle_tip = frame.t_s >= 5.0;
  EXPECT_NEAR(number(recording, "advance_visible_share"), 19.0 / 49.0, 1e-9) << "less 1 mm of play";
  auto still = straight([](double t) { return 30.0 + 0.49 * std::sin(40.0 * t); }, 7.0);
  EXPECT_EQ(value(still, "advance_visible_share").reason, "under_1_mm_of_advance");
  still.frames.clear();
  EXPECT_EQ(value(still, "advance_visible_share").reason, "no_picture");
  AttemptSetting s = setting();
  s.modality = cases::Modality::xray;
  EXPECT_EQ(value(recording, "advance_visible_share", s).reason, "not_meaningful_under_xray");
}

}  // namespace
}  // namespace seldinger::assessment
