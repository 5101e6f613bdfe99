// Tests of app/fluoroscopy and of attempts under X-ray: a ball of soft tissue with a lesion
// full of contrast agent.
#include "session/guidance/fluoroscopy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "app/attempts/this_program.h"
#include "assessment/operators/plan.h"
#include "assessment/score.h"
#include "session/attempt/endpoint_picture.h"
#include "session/attempt/replayed_attempt.h"
#include "session/attempt/simulated_attempt.h"
#include "sim/engine/step.h"
#include "sim/imaging/xray/beam/attenuation.h"
#include "sim/imaging/xray/c_arm.h"
#include "sim/imaging/xray/exposure.h"
#include "sim/imaging/xray/instruments.h"
#include "sim/tissue/breathing.h"
#include "tests/fixtures/ball_case.h"
#include "tests/session/guidance/stored_picture.h"

namespace seldinger::session {
namespace {

const cases::Case& ball(double lesion_hu = 500.0) {
  const auto make = [](double hu) {
    cases::Case scene = fixtures::ball_case({88, 2.5, 100.0, 40.0, 5});
    scene.lesions.push_back({{10.0, -40.0, -12.0}, 6.0, hu});
    scene.picture.modality = cases::Modality::xray;
    return scene;
  };
  static const cases::Case kContrast = make(500.0), kSoft = make(0.0);
  return lesion_hu == 500.0 ? kContrast : kSoft;
}

// A State with a pulse due, the needle at this tip and along this direction.
cases::State pulse(const cases::Case& scene, const glm::dvec3& tip_lps_mm, const glm::dvec3& direction,
                   const cases::FluoroscopeInputs& asked = {}) {
  cases::State state;
  cases::Inputs inputs;
  inputs.needle.position_lps_mm = tip_lps_mm;
  inputs.needle.axis = direction;
  inputs.fluoroscope = asked;
  inputs.fluoroscope.pedal = true;
  engine::step(scene, inputs, base::kTickS, state);
  EXPECT_TRUE(state.fluoroscopy.frame_due);
  return state;
}

constexpr glm::dvec3 kAcross(1.0, 0.0, 0.0), kAway(0.0, -60.0, 0.0);

TEST(FluoroscopySight, ReportsTheFrameOnceWithItsDose) {
  FluoroscopySight room(ball());
  const auto state = pulse(ball(), kAway, kAcross);
  const auto exposed = room.expose(state);
  EXPECT_EQ(exposed.report.frame, 1U);
  EXPECT_GT(exposed.report.air_kerma_mgy, 1e-4);
  EXPECT_LT(exposed.report.air_kerma_mgy, 1.0);
  // The dose–area product is the kerma at the reference point times the field's area there.
  const double reference_mm = 785.0 - 150.0, side_cm = 30.0 * reference_mm / 1100.0;
  EXPECT_NEAR(exposed.report.dap_mgy_cm2 / (exposed.report.air_kerma_mgy * side_cm * side_cm), 1.0, 1e-9);
  ASSERT_TRUE(exposed.truth.beam.has_value());
  EXPECT_EQ(exposed.truth.t_s, state.t_s);
  EXPECT_EQ(exposed.truth.beam->air_kerma_mgy, exposed.report.air_kerma_mgy);
  EXPECT_EQ(exposed.truth.beam->dap_mgy_cm2, exposed.report.dap_mgy_cm2);
  EXPECT_EQ(exposed.truth.beam->beam_s, 1.0 / 7.5);
  EXPECT_EQ(exposed.truth.beam->kv, state.fluoroscopy.last_technique.kv);
}

TEST(FluoroscopySight, SaysTheSameWhateverItSaidBefore) {
  FluoroscopySight used(ball());
  cases::FluoroscopeInputs tilted;
  tilted.magnification = 2;
  static_cast<void>(used.expose(pulse(ball(), kAway, kAcross, tilted)));
  static_cast<void>(used.picture(pulse(ball(), {0, 0, 0}, kAcross), 1));
  const auto state = pulse(ball(), {5, -40, 3}, kAcross);
  const auto a = used.expose(state), b = FluoroscopySight(ball()).expose(state);
  EXPECT_EQ(a.report, b.report);
  EXPECT_EQ(a.truth.beam, b.truth.beam);
  EXPECT_EQ(a.fix.tip_mm, b.fix.tip_mm);
  EXPECT_EQ(used.expose(state).report, a.report);
}

TEST(FluoroscopySight, CollimatingSparesAreaNotKerma) {
  FluoroscopySight room(ball());
  cases::FluoroscopeInputs narrow;
  narrow.collimator = {0.5, 0.4};
  const auto open = room.expose(pulse(ball(), kAway, kAcross));
  const auto shut = room.expose(pulse(ball(), kAway, kAcross, narrow));
  EXPECT_EQ(shut.report.air_kerma_mgy, open.report.air_kerma_mgy);
  EXPECT_NEAR(shut.report.dap_mgy_cm2 / open.report.dap_mgy_cm2, 0.2, 1e-9);
  EXPECT_NEAR(shut.truth.beam->collimated_share, 0.8, 1e-12);
}

TEST(FluoroscopySight, ShowsWhatIsInTheFieldAndHasContrast) {
  FluoroscopySight room(ball());
  const auto inside = room.expose(pulse(ball(), {0, -40, 0}, kAcross));
  EXPECT_TRUE(inside.truth.needle_tip);
  EXPECT_TRUE(inside.truth.target) << "6 mm of contrast agent either side";
  EXPECT_TRUE(inside.fix.tip && inside.fix.target && inside.fix.target_clear);
  EXPECT_GT(inside.truth.needle_length_mm, 50.0);
  // 785 + 40 mm from the source: the target, 10 mm left and 12 mm to the feet, magnified by 1100/825.
  EXPECT_NEAR(inside.fix.target_mm.x, 10.0 * 1100.0 / 825.0, 1e-9);
  EXPECT_NEAR(inside.fix.target_mm.y, 12.0 * 1100.0 / 825.0, 1e-9);

  cases::FluoroscopeInputs narrow;
  narrow.collimator = {0.05, 0.05};
  const auto shut = room.expose(pulse(ball(), {0, -40, 0}, kAcross, narrow));
  EXPECT_TRUE(shut.fix.tip);
  EXPECT_FALSE(shut.fix.target || shut.truth.target) << "behind the blades";

  FluoroscopySight soft_room(ball(0.0));
  const auto soft = soft_room.expose(pulse(ball(0.0), {0, -40, 0}, kAcross));
  EXPECT_FALSE(soft.truth.target) << "40 HU over 12 mm do not show";
  EXPECT_FALSE(soft.fix.target_clear);
  EXPECT_TRUE(soft.fix.target) << "who knows the anatomy finds it all the same, worse";
}

TEST(FluoroscopySight, SeesTheHandUnlessItIsAway) {
  FluoroscopySight room(ball());
  // Along the beam: the hand is over the tip.
  const glm::dvec3 down(0, 1, 0);
  EXPECT_TRUE(room.expose(pulse(ball(), kAway, down)).report.hand_in_beam);
  // Across, 120 mm beside the middle; the field is 300/2·845/1100 mm wide there.
  EXPECT_TRUE(room.expose(pulse(ball(), kAway, kAcross)).report.hand_in_beam);
  cases::FluoroscopeInputs narrow;
  narrow.collimator = {0.3, 0.3};
  EXPECT_FALSE(room.expose(pulse(ball(), kAway, kAcross, narrow)).report.hand_in_beam);
  EXPECT_TRUE(room.expose(pulse(ball(), kAway, down, narrow)).report.hand_in_beam);
  cases::FluoroscopeInputs away;
  away.hand_away = true;
  EXPECT_FALSE(room.expose(pulse(ball(), kAway, down, away)).report.hand_in_beam);
}

// As ball(), but it breathes: its dome is at its upper end.
const cases::Case& breathing_ball() {
  static const cases::Case kBreathing = [] {
    cases::Case scene = ball();
    scene.breathing.emplace();
    return scene;
  }();
  return kBreathing;
}

tissue::Displacement breathed_in(const cases::Case& scene, double level = 1.0) {
  return tissue::displacement_of(
      {.breath = tissue::Breath{*tissue::breath_region(scene), tissue::breath_amount_mm(*scene.breathing, level)}});
}

TEST(FluoroscopySight, ShowsTheTargetWhereTissueTookIt) {
  const cases::Case& scene = breathing_ball();
  const tissue::Displacement in = breathed_in(scene);
  const glm::dvec3 target = tissue::displaced(in, scene.lesions[0].center_lps_mm);
  ASSERT_GT(glm::length(target - scene.lesions[0].center_lps_mm), 5.0);
  FluoroscopySight room(scene);
  const auto state = pulse(scene, kAway, kAcross);
  const auto still = room.expose(state), moved = room.expose(state, in);
  EXPECT_EQ(moved.fix.tip_mm, still.fix.tip_mm) << "the needle is where the hand is";
  // 785 mm from the source to the middle: places are magnified by depth.
  const double magnified = 1100.0 / (785.0 - target.y);
  EXPECT_NEAR(moved.fix.target_mm.x, target.x * magnified, 1e-9);
  EXPECT_NEAR(moved.fix.target_mm.y, -target.z * magnified, 1e-9);
  EXPECT_TRUE(moved.truth.target);
  // Out of a field that holds it at rest.
  cases::FluoroscopeInputs narrow;
  narrow.collimator.open_u = 1.0;
  narrow.collimator.open_v = 2.0 * (std::abs(still.fix.target_mm.y) + 2.0) / 300.0;
  const auto shut = pulse(scene, kAway, kAcross, narrow);
  EXPECT_TRUE(room.expose(shut).truth.target);
  EXPECT_FALSE(room.expose(shut, in).truth.target);
}

TEST(FluoroscopySight, OfWhoLiesStillIsWhatItAlwaysWas) {
  const cases::Case& scene = breathing_ball();
  const auto state = pulse(scene, {0, -40, 0}, kAcross);
  FluoroscopySight used(scene), fresh(ball());
  const GreyPicture still = fresh.picture(state, 7);
  const auto exposed = fresh.expose(state);
  const GreyPicture in = used.picture(state, 7, breathed_in(scene));
  EXPECT_NE(used.expose(state, breathed_in(scene)).report, exposed.report) << "metered through other tissue";
  EXPECT_NE(in.grey, still.grey);
  EXPECT_EQ(used.picture(state, 7, {}).grey, still.grey);
  EXPECT_EQ(used.expose(state, {}).report, exposed.report);
  EXPECT_EQ(used.expose(state, {}).truth.beam, exposed.truth.beam);
  EXPECT_EQ(used.expose(state, {}).fix.target_mm, exposed.fix.target_mm);
  EXPECT_EQ(used.picture(state, 7, breathed_in(scene)).grey, in.grey);
  EXPECT_EQ(used.expose(state, breathed_in(scene)).report,
            FluoroscopySight(scene).expose(state, breathed_in(scene)).report);
}

// Cases of before scatter nothing: what their pulses ask and show is what it was.
TEST(FluoroscopySight, ScattersByTheCasesLawOfSight) {
  cases::Case older = ball();
  older.sight_law = cases::SightLaw::echo;
  const auto state = pulse(ball(), {0, -40, 0}, kAcross);
  FluoroscopySight room(ball()), older_room(older);
  const auto exposed = room.expose(state), before = older_room.expose(state);
  EXPECT_EQ(exposed.report.air_kerma_mgy, before.report.air_kerma_mgy) << "of what the tube was set to";
  EXPECT_NE(exposed.report.next, before.report.next) << "the panel gets scatter, too";
  EXPECT_NE(room.picture(state, 7).grey, older_room.picture(state, 7).grey);
  // By hand: primary only.
  const cases::FluoroscopyState& machine = state.fluoroscopy;
  const imaging::XrayGeometry geometry =
      imaging::c_arm_geometry(older.fluoroscope, machine.arm, machine.magnification, 64, older.position);
  imaging::PathLengths lengths =
      imaging::XrayCpu(older.volume).project(geometry, imaging::ProjectionMethod::exact, {.threads = 1});
  const imaging::Inserted inserted{
      imaging::needle_pose(older.instrument, state.needle.tip_lps_mm, state.needle.direction), older.lesions};
  imaging::overlay_instruments(older.volume, geometry, inserted, imaging::ProjectionMethod::exact, lengths);
  imaging::Beams beams(older.fluoroscope);
  const imaging::Pulse primary{machine.last_technique, machine.arm.sid_mm, machine.magnification,
                               machine.collimator};
  EXPECT_EQ(before.report.next,
            imaging::meter(beams, imaging::AutomaticExposure(older.fluoroscope), primary, lengths, {}).next);
}

// A ball with a vessel of 243 HU through it, its target beside that; the scanner's voltage is known.
cases::Case enhanced_ball() {
  cases::Case scene = breathing_ball();
  scene.classes.assign(scene.volume.hu.size(), volume::TissueClass::soft_tissue);
  for (int k = 0; k < scene.volume.size_voxels.z; ++k)
    for (int j = 0; j < scene.volume.size_voxels.y; ++j)
      for (int i = 0; i < scene.volume.size_voxels.x; ++i) {
        const std::size_t voxel = scene.volume.index(i, j, k);
        if (scene.volume.hu[voxel] < 0 || glm::length(glm::dvec2(i - 40, k - 44)) > 4.0) continue;
        scene.volume.hu[voxel] = 243;
        scene.classes[voxel] = volume::TissueClass::vessel;
      }
  scene.ct_tube_kv = 80.0;
  return scene;
}

// Cases of earlier laws know nothing of it, to the bit; nor does one of today that has no classes and no voltage.
TEST(FluoroscopySight, TellsIodineByTheCasesLawOfSight) {
  const cases::Case scene = enhanced_ball();
  cases::Case older = scene, nothing_known = scene, older_nothing = scene, usual_kv = scene;
  older.sight_law = older_nothing.sight_law = cases::SightLaw::clutter;
  for (cases::Case* one : {&nothing_known, &older_nothing}) {
    one->classes.clear();
    one->ct_tube_kv.reset();
  }
  usual_kv.ct_tube_kv = 120.0;
  const auto state = pulse(scene, {0, -40, 0}, kAcross);
  for (const tissue::Displacement& displacement : {tissue::Displacement{}, breathed_in(scene)}) {
    const auto of = [&](const cases::Case& one) {
      FluoroscopySight room(one);
      return std::pair(room.expose(state, displacement).report, room.picture(state, 7, displacement).grey);
    };
    const auto today = of(scene), before = of(older);
    EXPECT_EQ(before, of(older_nothing));
    EXPECT_EQ(before, of(nothing_known));
    EXPECT_NE(today.first.next, before.first.next);
    EXPECT_NE(today.second, before.second);
    EXPECT_NE(today.second, of(usual_kv).second);
  }
}

// What is metered is what stands in the picture: by hand from lengths of iodine, mineral and water.
TEST(FluoroscopySight, MetersTheCtsIodine) {
  cases::Case scene = enhanced_ball();
  const auto state = pulse(scene, kAway, kAcross);
  FluoroscopySight room(scene);
  const cases::FluoroscopyState& machine = state.fluoroscopy;
  const imaging::XrayGeometry geometry =
      imaging::c_arm_geometry(scene.fluoroscope, machine.arm, machine.magnification, 64, scene.position);
  cases::Case plain = scene;
  volume::Volume vessel = scene.volume;
  for (std::size_t i = 0; i < vessel.hu.size(); ++i) {
    const bool blood = scene.classes[i] == volume::TissueClass::vessel;
    if (blood) plain.volume.hu[i] = 43;
    vessel.hu[i] = blood ? -800 : -1000;
  }
  const auto project = [&](const volume::Volume& volume) {
    return imaging::XrayCpu(volume).project(geometry, imaging::ProjectionMethod::exact, {.threads = 1});
  };
  const double ct_kev = imaging::ct_effective_kev(80.0);
  imaging::PathLengths lengths = project(plain.volume);
  lengths.contrast_mm = project(vessel).water_mm;
  for (float& mm : lengths.contrast_mm) mm *= static_cast<float>(imaging::contrast_mm_of_1000_hu(ct_kev));
  imaging::Beams beams(scene.fluoroscope, {}, {ct_kev, true});
  imaging::Pulse by_hand{machine.last_technique, machine.arm.sid_mm, machine.magnification, machine.collimator};
  by_hand.scatter = imaging::scatter_share(beams, by_hand, lengths);
  const imaging::Inserted inserted{
      imaging::needle_pose(scene.instrument, state.needle.tip_lps_mm, state.needle.direction), scene.lesions};
  imaging::overlay_instruments(plain.volume, geometry, inserted, imaging::ProjectionMethod::exact, lengths);
  const auto next = imaging::meter(beams, imaging::AutomaticExposure(scene.fluoroscope), by_hand, lengths, {}).next;
  const auto exposed = room.expose(state).report.next;
  EXPECT_EQ(exposed.kv, next.kv);
  EXPECT_NEAR(exposed.ma / next.ma, 1.0, 1e-3);
}

TEST(FluoroscopySight, OfAnEnhancedPatientWhoLiesStillIsWhatItAlwaysWas) {
  const cases::Case scene = enhanced_ball();
  const auto state = pulse(scene, {0, -40, 0}, kAcross);
  FluoroscopySight used(scene), fresh(scene);
  const GreyPicture still = fresh.picture(state, 7);
  const auto exposed = fresh.expose(state);
  EXPECT_NE(used.picture(state, 7, breathed_in(scene)).grey, still.grey);
  EXPECT_NE(used.expose(state, breathed_in(scene)).report, exposed.report);
  EXPECT_EQ(used.picture(state, 7).grey, still.grey);
  EXPECT_EQ(used.expose(state).report, exposed.report);
  EXPECT_EQ(used.expose(state, breathed_in(scene)).report,
            FluoroscopySight(scene).expose(state, breathed_in(scene)).report);
}

TEST(FluoroscopySight, AutomaticExposureSettlesThroughStep) {
  FluoroscopySight room(ball());
  cases::State state;
  cases::Inputs inputs;
  inputs.fluoroscope.pedal = true;
  cases::Technique before, last;
  for (int i = 0; i < 3000; ++i) {
    engine::step(ball(), inputs, base::kTickS, state);
    if (!state.fluoroscopy.frame_due) continue;
    before = last;
    last = state.fluoroscopy.last_technique;
    inputs.exposure = room.expose(state).report;
  }
  EXPECT_EQ(state.fluoroscopy.frames, 23U);
  EXPECT_EQ(state.fluoroscopy.reported, 23U);
  EXPECT_NE(last, cases::Technique{}) << "it is not what it began with";
  EXPECT_NEAR(last.kv, before.kv, 1.0);
  EXPECT_NEAR(last.ma / before.ma, 1.0, 0.05) << "and has come to rest";
}

cases::Recording attempt_of(const std::string& who, std::uint64_t seed) {
  const cases::Case& scene = ball();
  const auto plan =
      assessment::plan_puncture(scene.volume, scene.skin_index, scene.lesions[0].center_lps_mm,
                                assessment::path_limits(cases::Modality::xray, cases::PatientPosition::supine));
  EXPECT_TRUE(plan.has_value());
  return run_attempt(scene, *plan, *assessment::named_profile(who), seed);
}

TEST(XrayAttempt, IsReplayedBitForBitWithoutImaging) {
  const cases::Recording recording = attempt_of("novice", 3);
  ASSERT_TRUE(recording.endpoint.has_value());
  EXPECT_TRUE(replay(ball(), recording).same);
  const auto stored = cases::recording_from_chunks(cases::chunks_from_recording(recording));
  ASSERT_TRUE(stored.has_value());
  EXPECT_TRUE(replay(ball(), *stored).same);
  // A dose that was not so is found out at the tick that takes it in.
  cases::Recording forged = recording;
  std::size_t tick = 0;
  while (forged.inputs[tick].exposure.frame == 0) ++tick;
  forged.inputs[tick].exposure.air_kerma_mgy *= 0.5;
  const Replay found = replay(ball(), forged);
  EXPECT_FALSE(found.same);
  EXPECT_EQ(found.first_difference_tick, tick + 1);
}

TEST(XrayAttempt, ItsMetricsAreWhatTheMachineAddedUp) {
  for (const char* who : {"novice", "expert"}) {
    const cases::Recording recording = attempt_of(who, 1);
    const auto metrics = assessment::measure(ball(), recording);
    ASSERT_TRUE(metrics.has_value());
    cases::State state;
    for (const cases::Inputs& inputs : recording.inputs) {
      if (state.fire.fired) break;
      engine::step(ball(), inputs, recording.dt_s, state);
    }
    const cases::FluoroscopyState& machine = state.fluoroscopy;
    const auto value = [&](const std::string& id) {
      for (const auto& metric : *metrics)
        if (metric.id == id) return metric.value.value_or(std::nan(""));
      return std::nan("");
    };
    EXPECT_GT(machine.frames, 5U);
    EXPECT_NEAR(value("fluoroscopy_time"), machine.fluoroscopy_time_s, 1e-9);
    EXPECT_NEAR(value("air_kerma"), machine.air_kerma_mgy, 1e-9);
    EXPECT_NEAR(value("dap"), machine.dap_mgy_cm2 / 1000.0, 1e-9);
    EXPECT_NEAR(value("hand_in_beam"), machine.hand_in_beam_s, 1e-9);
    EXPECT_NEAR(value("beam_while_moving"), machine.beam_while_moving_s, 1e-9);
    EXPECT_NEAR(value("collimated_share"), machine.collimated_share(), 1e-9);
    EXPECT_EQ(value("views"), machine.views.count);
  }
}

TEST(XrayAttempt, HasThePictureOfItsLastPulse) {
  const cases::Recording recording = attempt_of("expert", 1);
  const auto png = stored_picture(ball(), recording);
  ASSERT_GT(png.size(), 1000U);
  EXPECT_EQ(png[1], std::byte{'P'});
  EXPECT_EQ(png, stored_picture(ball(), recording));
  cases::Recording never = recording;
  for (cases::Inputs& inputs : never.inputs) inputs.fluoroscope.pedal = false;
  EXPECT_TRUE(stored_picture(ball(), never).empty()) << "nobody exposed anything";
}

TEST(XrayAttempt, FramesEndWithAHeldImage) {
  const cases::Recording recording = attempt_of("expert", 2);
  ASSERT_FALSE(recording.frames.empty());
  std::size_t pulses = 0, held = 0;
  for (const cases::FrameTruth& frame : recording.frames) {
    EXPECT_EQ(frame.live, frame.beam.has_value());
    (frame.live ? pulses : held) += 1;
  }
  EXPECT_GT(pulses, 5U);
  EXPECT_GT(held, 3U);
  EXPECT_FALSE(recording.frames.back().live);
}

}  // namespace
}  // namespace seldinger::session
