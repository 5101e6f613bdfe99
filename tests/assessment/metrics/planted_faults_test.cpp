// Faults that older versions of metrics had, planted again: what each would have said is in a comment beside what
// the metric says now. Those of movement are elsewhere.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "assessment/registry.h"
#include "assessment/score.h"
#include "assessment/signals/signals.h"
#include "assessment/signals/target_view.h"
#include "tests/assessment/metrics/flat_body.h"

namespace seldinger::assessment {
namespace {

using cases::StructureRule;

// One attempt, built up by the tests.
struct Planted {
  AttemptSetting setting;
  std::vector<cases::Structure> structures;
  cases::Recording recording;

  Planted() {
    setting.skin = &body();
    setting.target = cases::Lesion{{0.0, 60.0, 0.0}, 6.0, 20.0};
    recording.events.emplace();
  }
  // Straight down as deep as told, 100 times a second, with a picture that shows everything.
  Planted& down(const std::function<double(double)>& depth_mm, double seconds) {
    for (int i = 0; i <= static_cast<int>(std::lround(seconds * 100.0)); ++i) {
      cases::PoseSample pose;
      pose.t_s = i / 100.0;
      pose.tip_lps_mm = {0.0, depth_mm(pose.t_s), 0.0};
      pose.needle_direction = {0.0, 1.0, 0.0};
      recording.poses.push_back(pose);
      recording.frames.push_back({pose.t_s, true, true, true, 10.0});
    }
    return *this;
  }
  Planted& fire() {
    const cases::PoseSample& last = recording.poses.back();
    recording.endpoint = cases::Endpoint{last.t_s, last.tip_lps_mm, last.needle_direction};
    return *this;
  }
  Planted& with(StructureRule rule, cases::Shape shape) {
    cases::Structure structure;
    structure.rule = rule;
    structure.shape = std::move(shape);
    structures.push_back(std::move(structure));
    return *this;
  }
  MetricValue value(const std::string& id) const {
    AttemptSetting here = setting;
    here.structures = structures;
    const auto signals = make_signals(here, recording);
    EXPECT_TRUE(signals.has_value());
    for (const MetricValue& metric : measure_all(*signals))
      if (metric.id == id) return metric;
    ADD_FAILURE() << id;
    return {};
  }
  double number(const std::string& id) const {
    const MetricValue metric = value(id);
    EXPECT_TRUE(metric.value.has_value()) << id << ": " << metric.reason;
    return metric.value.value_or(std::nan(""));
  }
};

double to_30(double t_s) {
  return std::fmin(-20.0 + 20.0 * t_s, 30.0);
}

// A ball of 20 mm that the way down meets with a chord of so many mm, 30 mm deep.
cases::Shape grazed(double chord_mm) {
  return cases::Sphere{{std::sqrt(400.0 - chord_mm * chord_mm / 4.0), 30.0, 0.0}, 20.0};
}

TEST(PlantedNoGo, AGrazeOfATwentiethOfAMillimetreIsNone) {
  Planted graze;
  graze.with(StructureRule::critical, grazed(0.05)).down([](double t) { return -20.0 + 20.0 * t; }, 4.0).fire();
  EXPECT_EQ(graze.number("nogo_contacts"), 0.0);
  EXPECT_EQ(graze.number("nogo_length"), 0.0);           // 1: 0.05 mm
  EXPECT_EQ(graze.number("nogo_length_critical"), 0.0);  // 1: 0.05 mm, a critical error in every graded case
  EXPECT_EQ(graze.number("nogo_time"), 0.0);             // 1: 0.00 or 0.01 s, as samples fell
  EXPECT_NEAR(graze.number("clearance_min"), 0.0, 0.01) << "how near it came is told as it is";
}

TEST(PlantedNoGo, AVisitCountsFromItsEntry) {
  Planted one;
  one.with(StructureRule::major, grazed(2.0)).down([](double t) { return -20.0 + 20.0 * t; }, 4.0).fire();
  EXPECT_EQ(one.number("nogo_contacts"), 1.0);
  EXPECT_NEAR(one.number("nogo_length"), 2.0, 0.01) << "not 2 mm less the half that made it a visit";
  EXPECT_NEAR(one.number("nogo_length_major"), 2.0, 0.01);
  EXPECT_NEAR(one.number("nogo_time"), 0.1, 0.011);
  // A visit and a graze: the graze adds nothing.
  one.with(StructureRule::critical, cases::Sphere{{std::sqrt(400.0 - 0.04), 50.0, 0.0}, 20.0});
  EXPECT_EQ(one.number("nogo_contacts"), 1.0);
  EXPECT_NEAR(one.number("nogo_length"), 2.0, 0.01);  // 1: 2.4 mm
  EXPECT_EQ(one.number("nogo_length_critical"), 0.0);
}

// 0.3 mm in, 0.2 out, 0.3 in: one visit, as contacts count; its way outside is no way inside.
TEST(PlantedNoGo, PartsOfOneVisitAddUp) {
  Planted parts;
  parts.with(StructureRule::critical, cases::Sphere{{std::sqrt(400.0 - 0.15 * 0.15), 30.0, 0.0}, 20.0})
      .with(StructureRule::critical, cases::Sphere{{std::sqrt(400.0 - 0.15 * 0.15), 30.5, 0.0}, 20.0})
      .down([](double t) { return -20.0 + 20.0 * t; }, 4.0)
      .fire();
  EXPECT_EQ(parts.number("nogo_contacts"), 0.0) << "two structures, grazed once each";
  EXPECT_EQ(parts.number("nogo_length"), 0.0);  // 1: 0.6 mm
}

TEST(PlantedNoGo, WhoRestsInAVesselIsInItAsLong) {
  Planted resting;
  resting.with(StructureRule::critical, cases::Sphere{{0.0, 30.0, 0.0}, 5.0}).down(to_30, 12.5).fire();
  EXPECT_NEAR(resting.number("nogo_time"), 10.25, 0.02);
  EXPECT_NEAR(resting.number("nogo_length"), 5.0, 0.01);
}

TEST(PlantedNoGo, HalfAVoxelIsTold) {
  Planted drawn;
  drawn.with(StructureRule::major, grazed(2.0)).down(to_30, 4.0).fire();
  EXPECT_EQ(drawn.number("nogo_uncertainty"), 0.0);
  cases::VoxelSet voxels;
  voxels.size = {2, 2, 2};
  voxels.spacing_mm = {0.8, 0.8, 3.0};
  voxels.member.assign(8, 1);
  drawn.with(StructureRule::target, voxels);
  EXPECT_EQ(drawn.number("nogo_uncertainty"), 0.0) << "nobody has to stay out of it";
  drawn.with(StructureRule::critical, voxels);
  EXPECT_EQ(drawn.number("nogo_uncertainty"), 1.5);  // 1: not told
  EXPECT_NE(std::string(find_metric("clearance_min")->definition).find("nogo_uncertainty"), std::string::npos);
}

// Case 4 of docs/clinical.md: in the middle of the vein, 20 mm along it from where the lesion marks it.
TEST(PlantedHit, IsAnywhereInTheLumenThatIsToBeReached) {
  Planted vein;
  vein.with(StructureRule::target, cases::Tube{{{0.0, 30.0, -50.0}, {0.0, 30.0, 50.0}}, 6.0});
  vein.setting.target = cases::Lesion{{0.0, 30.0, 20.0}, 6.0, 20.0};
  vein.down(to_30, 4.0).fire();
  EXPECT_EQ(vein.number("hit"), 1.0);                 // 1: 0
  EXPECT_EQ(vein.number("first_pass_success"), 1.0);  // 1: 0
  EXPECT_NEAR(vein.number("tip_target_dist"), 20.0, 1e-9);
  EXPECT_NEAR(vein.number("back_wall_dist"), 6.0, 1e-6);
}

TEST(PlantedHit, BesideTheLumenIsNoneThoughALesionReachesThere) {
  Planted beside;
  beside.with(StructureRule::target, cases::Tube{{{0.0, 40.0, -50.0}, {0.0, 40.0, 50.0}}, 6.0});
  beside.setting.target = cases::Lesion{{0.0, 36.0, 0.0}, 8.0, 20.0};
  beside.down(to_30, 4.0).fire();
  EXPECT_EQ(beside.number("hit"), 0.0);  // 1: 1
  beside.structures.clear();
  EXPECT_EQ(beside.number("hit"), 1.0) << "without a lumen the lesion is the target";
  // A core needle takes tissue: its notch is in the lesion or not.
  beside.with(StructureRule::target, cases::Sphere{{0.0, 150.0, 0.0}, 5.0});
  beside.setting.instrument.kind = cases::InstrumentKind::core;
  EXPECT_EQ(beside.number("hit"), 1.0);
}

TEST(PlantedBreath, HoldingTheBreathForLongIsNeitherGoodNorBad) {
  EXPECT_EQ(find_metric("breath_hold_time")->direction,
            Direction::none);  // before: lower is better, never asking best
}

TEST(PlantedVisibility, WhatIsFrozenWasNotSeen) {
  Planted frozen;  // in tissue from 1 s on; unseen from 3 s on, and frozen then
  frozen.down([](double t) { return t < 1.0 ? -5.0 : 30.0; }, 11.0).fire();
  for (auto& frame : frozen.recording.frames)
    if (frame.t_s >= 3.0) frame.live = false;
  for (const char* id : {"vis_needle", "vis_target", "vis_joint", "vis_shaft"})
    EXPECT_NEAR(frozen.number(id), 0.2, 1e-9) << id;               // 1: 1.0
  EXPECT_NEAR(frozen.number("visible_needle_length"), 2.0, 1e-9);  // 1: 10 mm
  for (auto& frame : frozen.recording.frames) frame.live = false;
  EXPECT_EQ(frozen.number("vis_needle"), 0.0);  // 1: null
}

TEST(PlantedVisibility, BetweenTwoPulsesNobodyIsAskedToLook) {
  Planted pulsed;
  pulsed.setting.modality = cases::Modality::xray;
  pulsed.down([](double) { return 30.0; }, 10.0).fire();
  for (auto& frame : pulsed.recording.frames) frame.live = frame.t_s < 4.0;
  EXPECT_NEAR(pulsed.number("vis_needle"), 1.0, 1e-9);
}

volume::Volume water(int side) {
  volume::Volume made;
  made.size_voxels = glm::ivec3(side);
  made.spacing_mm = glm::dvec3(2.0);
  made.lps_from_voxel = glm::dmat4(2.0);
  made.lps_from_voxel[3][3] = 1.0;
  made.hu.assign(static_cast<std::size_t>(side) * side * side, 0);
  return made;
}

TEST(PlantedVisibility, ATargetThatNoFluoroscopeShowsHasNoShare) {
  cases::Case scene;
  scene.volume = water(40);
  scene.picture.modality = cases::Modality::xray;
  scene.lesions = {cases::Lesion{{40.0, 40.0, 40.0}, 7.5, 40.0}};
  EXPECT_TRUE(target_cannot_show(scene)) << "40 HU of 15 mm: 1.4 %";
  scene.lesions[0].hu = 300.0;  // contrast agent: 10 %
  EXPECT_FALSE(target_cannot_show(scene));
  scene.lesions[0].hu = 40.0;
  scene.picture.modality = cases::Modality::ultrasound;
  EXPECT_FALSE(target_cannot_show(scene));

  Planted soft;
  soft.setting.modality = cases::Modality::xray;
  soft.setting.target_cannot_show = true;
  soft.down([](double) { return 30.0; }, 10.0).fire();
  for (auto& frame : soft.recording.frames) frame.target = false;
  for (const char* id : {"vis_target", "vis_joint", "vis_joint_session"})
    EXPECT_EQ(soft.value(id).reason, "no_view_shows_target") << id;  // 1: 0
  EXPECT_EQ(soft.number("vis_needle"), 1.0);
  soft.recording.frames[3].target = true;
  EXPECT_GT(soft.number("vis_target"), 0.0) << "what was shown can be shown";
}

// 30 × 30 cm at 1100 mm are 459 cm² at the isocentre; the target and 20 mm about it are 5.2 × 5.2 cm.
TEST(PlantedCollimator, ToShutOffTheTargetEarnsNothing) {
  const auto share = [](double shut) {
    Planted planted;
    planted.setting.modality = cases::Modality::xray;
    planted.down([](double) { return 30.0; }, 4.0).fire();
    planted.recording.frames.clear();
    const double at_reference_cm2 = 900.0 * (635.0 / 1100.0) * (635.0 / 1100.0);
    cases::FrameTruth frame;
    frame.t_s = 1.0;
    frame.beam = cases::BeamTruth{0.0,  0.0,       72.0,  40.0, 0.02, 0.02 * at_reference_cm2 * (1.0 - shut),
                                  shut, 1.0 / 7.5, false, false};
    planted.recording.frames.push_back(frame);
    return planted.value("collimated_share");
  };
  const double most = 1.0 - 52.0 * 52.0 / (214.09 * 214.09);  // 300 mm · 785/1100
  EXPECT_NEAR(*share(0.5).value, 0.5, 1e-9);
  EXPECT_NEAR(*share(0.9).value, 0.9, 1e-9);
  EXPECT_NEAR(*share(0.9975).value, most, 1e-4);  // 1: 0.9975, the best there is, with the target outside
  EXPECT_EQ(find_metric("collimated_share")->version, 2);
}

TEST(PlantedCollimator, WithoutADoseTheFieldIsNotKnown) {
  Planted planted;
  planted.setting.modality = cases::Modality::xray;
  planted.down([](double) { return 30.0; }, 4.0).fire();
  planted.recording.frames.resize(1);
  planted.recording.frames[0].beam = cases::BeamTruth{0, 0, 72, 40, 0.0, 0.0, 0.5, 0.1, false, false};
  EXPECT_EQ(planted.value("collimated_share").reason, "field_not_known");
}

TEST(PlantedTime, IsToldInThreePartsThatAddUp) {
  Planted timed;  // 4 s of talk, 2 s down to the skin, 6 s in tissue, 1 s out
  timed
      .down([](double t) { return t < 4.0    ? -40.0
                                  : t < 6.0  ? -40.0 + 20.0 * (t - 4.0)
                                  : t < 12.0 ? 20.0
                                             : -10.0; },
            13.0)
      .fire();
  EXPECT_NEAR(timed.number("time_talk"), 4.26, 0.02) << "until it is 5 mm away";  // 1: all of it was time_total
  EXPECT_NEAR(timed.number("time_needle"), 6.0, 0.02);
  EXPECT_NEAR(timed.number("time_talk") + timed.number("time_search") + timed.number("time_needle"),
              timed.number("time_total"), 1e-9);
  // The probe at work is no talk, and neither is a pulse.
  Planted probe = timed;
  for (auto& pose : probe.recording.poses)
    if (pose.t_s > 1.0) pose.probe_lateral = {0.9, 0.0, std::sqrt(1.0 - 0.81)};
  EXPECT_NEAR(probe.number("time_talk"), 1.01, 0.011);
  Planted pulse = timed;
  pulse.recording.frames[200].beam = cases::BeamTruth{};
  EXPECT_NEAR(pulse.number("time_talk"), 2.0, 0.011);
  EXPECT_NEAR(pulse.number("time_talk") + pulse.number("time_search") + pulse.number("time_needle"), 13.0, 1e-9);
}

TEST(PlantedTime, AGapIsInOneOfTheParts) {
  Planted gap;
  gap.down([](double t) { return t < 2.0 ? -40.0 : 20.0; }, 8.0).fire();
  std::erase_if(gap.recording.poses, [](const auto& pose) { return pose.t_s > 4.0 && pose.t_s < 6.0; });
  EXPECT_NEAR(gap.number("time_needle"), 6.0, 0.02);
  EXPECT_NEAR(gap.number("time_in_tissue"), 4.0, 0.02) << "of a gap it tells nothing";
  EXPECT_NEAR(gap.number("time_talk") + gap.number("time_search") + gap.number("time_needle"), 8.0, 1e-9);
}

TEST(PlantedWithdrawal, OutOfTheSkinByHalfAMillimetreIsOne) {
  // 40 mm in at 3 s, 0.5 mm outside at 5.025 s, in again from 6 s on and fired in the target.
  const auto depth_mm = [](double t_s) {
    return t_s < 3.0   ? -20.0 + 20.0 * t_s
           : t_s < 6.0 ? std::fmax(-0.5, 40.0 - 20.0 * (t_s - 3.0))
                       : std::fmin(60.0, -0.5 + 20.0 * (t_s - 6.0));
  };
  Planted again;
  again.down(depth_mm, 9.5).fire();
  EXPECT_EQ(again.number("hit"), 1.0);
  EXPECT_EQ(again.number("skin_punctures"), 1.0);
  EXPECT_EQ(again.number("withdrawals_full"), 0.0);
  EXPECT_EQ(again.number("withdrawals_partial"), 1.0);  // 2: 0
  EXPECT_EQ(again.number("first_pass_success"), 0.0);   // 2: 1
  EXPECT_EQ(again.number("withdrawn_at_end"), 0.0);
  Planted out;
  EXPECT_EQ(out.down(depth_mm, 5.5).number("withdrawn_at_end"), 1.0);  // 1: 0
  EXPECT_EQ(out.number("withdrawals_partial"), 0.0) << "it was not pushed on";
}

TEST(PlantedPerformed, WhoParksOrTalksHasPerformedNothing) {
  Planted parked;
  parked.with(StructureRule::critical, grazed(5.0)).down([](double) { return -5.0; }, 20.0);
  using enum cases::EventKind;
  for (const auto kind : {sign_in, proceed, probe_checked, note_plan, aspirate, anaesthetic, nick, sign_out})
    parked.recording.events->push_back({1.0, kind});
  EXPECT_EQ(parked.number("procedure_performed"), 0.0);
  // 1: nothing told that these best values are of nobody's doing.
  for (const char* id : {"nogo_contacts", "nogo_length", "skin_punctures", "time_needle"})
    EXPECT_EQ(parked.number(id), 0.0) << id;
  Planted deferred = parked;
  deferred.recording.events->push_back({2.0, defer});
  EXPECT_EQ(deferred.number("procedure_performed"), 1.0);
  Planted fired = parked;
  EXPECT_EQ(fired.fire().number("procedure_performed"), 1.0) << "beside the patient, but for good";
  Planted punctured;
  punctured.down(to_30, 4.0);
  EXPECT_EQ(punctured.number("procedure_performed"), 1.0);
}

TEST(Registry, SaysWhatIsEstimatedAndWhatOlderVersionsDid) {
  for (const MetricInfo& info : registry()) {
    const bool failure = info.estimand.without_endpoint != WithoutEndpoint::left_out;
    EXPECT_FALSE(failure && info.direction == Direction::none) << info.id << ": the worst of what?";
    if (std::string(info.unit) == "bool") {
      EXPECT_EQ(info.estimand.scale, Scale::yes_no) << info.id;
    }
    EXPECT_TRUE(info.version == 1 || *info.history != '\0') << info.id;
  }
}

}  // namespace
}  // namespace seldinger::assessment
