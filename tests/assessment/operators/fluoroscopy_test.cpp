// Tests of assessment/operators/fluoroscopy: at a sphere-shaped patient, with shadows in place of pictures.
#include "assessment/operators/fluoroscopy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "sim/devices/virtual_arm.h"
#include "sim/engine/step.h"
#include "tests/fixtures/meshes.h"

namespace seldinger::assessment {
namespace {

cases::Case patient(cases::PatientPosition position) {
  cases::Case scene;
  scene.skin = fixtures::sphere_mesh({0, 0, 0}, 110.0, 5);
  scene.skin_index = cases::MeshIndex(scene.skin);
  const double front = position == cases::PatientPosition::prone ? 1.0 : -1.0;
  scene.lesions.push_back({{12.0, front * 45.0, -8.0}, 6.0, 500.0});
  scene.picture.modality = cases::Modality::xray;
  scene.position = position;
  return scene;
}

PuncturePlan plan_of(const cases::Case& scene) {
  const double front = scene.position == cases::PatientPosition::prone ? 1.0 : -1.0;
  PuncturePlan plan;
  plan.target_lps_mm = scene.lesions[0].center_lps_mm;
  plan.direction = glm::normalize(glm::dvec3(-0.3, -front, 0.2));
  plan.depth_mm = scene.skin_index.first_hit(plan.target_lps_mm, -plan.direction, 300.0)->distance_mm;
  plan.entry_lps_mm = plan.target_lps_mm - plan.direction * plan.depth_mm;
  return plan;
}

struct Outcome {
  bool fired = false;
  double miss_mm = 0.0;
  cases::FluoroscopyState machine;
  double pedal_without_hand_away_s = 0.0, t_s = 0.0;
  std::uint64_t hash = 0;
};

Outcome attempt(const cases::Case& scene, const std::string& who, std::uint64_t seed, bool target_clear = true) {
  const PuncturePlan plan = plan_of(scene);
  FluoroscopyOperator person(*named_profile(who), plan, scene.instrument, scene.fluoroscope, scene.position, seed);
  devices::VirtualArm arm;
  cases::State state;
  cases::ExposureReport report;
  PictureFix fix;
  Outcome outcome;
  bool new_frame = false;
  while (!person.done() && state.t_s < 300.0) {
    cases::Inputs inputs = person.act(state, new_frame ? &fix : nullptr, base::kTickS);
    inputs.needle = arm.advance(inputs.needle, base::kTickS);
    inputs.exposure = report;
    engine::step(scene, inputs, base::kTickS, state);
    outcome.hash = cases::state_hash(state, outcome.hash);
    const cases::FluoroscopyState& machine = state.fluoroscopy;
    if (machine.beam_on && !machine.hand_away) outcome.pedal_without_hand_away_s += base::kTickS;
    new_frame = machine.frame_due;
    if (!new_frame) continue;
    const cases::BeamFrame frame = cases::beam_frame(scene.fluoroscope, machine.arm, scene.position);
    const auto tip = cases::shadow_of(frame, state.needle.tip_lps_mm);
    const auto target = cases::shadow_of(frame, scene.lesions[0].center_lps_mm);
    const auto inside = [&](const glm::dvec2& place) {
      return cases::inside_field(scene.fluoroscope, machine.magnification, machine.collimator, place);
    };
    fix = {inside(tip->detector_mm), inside(target->detector_mm), target_clear, tip->detector_mm,
           target->detector_mm};
    report = {machine.frames, 0.01, 1.0, machine.technique, !machine.hand_away};
  }
  outcome.fired = state.fire.fired;
  outcome.miss_mm = glm::length(state.fire.tip_lps_mm - scene.lesions[0].center_lps_mm);
  outcome.machine = state.fluoroscopy;
  outcome.t_s = state.t_s;
  return outcome;
}

TEST(FluoroscopyOperator, TheExpertHitsWithTwoViewsAndNoHandInTheBeam) {
  for (const auto position : {cases::PatientPosition::supine, cases::PatientPosition::prone}) {
    const cases::Case scene = patient(position);
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const Outcome outcome = attempt(scene, "expert", seed);
      ASSERT_TRUE(outcome.fired) << seed;
      EXPECT_LE(outcome.miss_mm, 6.0) << seed;
      EXPECT_GE(outcome.machine.views.count, 2) << seed;
      EXPECT_GE(outcome.machine.views.widest_deg, 30.0) << seed;
      EXPECT_EQ(outcome.machine.hand_in_beam_s, 0.0) << seed;
      EXPECT_EQ(outcome.machine.beam_while_moving_s, 0.0) << seed;
      EXPECT_LT(outcome.machine.fluoroscopy_time_s, 60.0) << seed;
      EXPECT_GT(outcome.machine.collimated_share(), 0.5) << seed;
    }
  }
}

TEST(FluoroscopyOperator, TheExpertHitsADeepTargetToo) {
  cases::Case scene = patient(cases::PatientPosition::supine);
  scene.lesions[0].center_lps_mm = {8.0, 20.0, 10.0};
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Outcome outcome = attempt(scene, "expert", seed);
    ASSERT_TRUE(outcome.fired) << seed;
    EXPECT_LE(outcome.miss_mm, 6.0) << seed;
  }
}

TEST(FluoroscopyOperator, TheNoviceIsWorseInTheMean) {
  const cases::Case scene = patient(cases::PatientPosition::supine);
  Outcome sum_expert, sum_novice;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const bool expert : {true, false}) {
      const Outcome one = attempt(scene, expert ? "expert" : "novice", seed);
      ASSERT_TRUE(one.fired) << seed;
      Outcome& sum = expert ? sum_expert : sum_novice;
      sum.miss_mm += one.miss_mm;
      sum.machine.fluoroscopy_time_s += one.machine.fluoroscopy_time_s;
      sum.machine.hand_in_beam_s += one.machine.hand_in_beam_s;
      sum.machine.beam_while_moving_s += one.machine.beam_while_moving_s;
      sum.machine.views.count += one.machine.views.count;
      sum.t_s += one.t_s;
    }
  EXPECT_GT(sum_novice.miss_mm, 1.5 * sum_expert.miss_mm);
  EXPECT_GT(sum_novice.machine.fluoroscopy_time_s, 2.0 * sum_expert.machine.fluoroscopy_time_s);
  EXPECT_GT(sum_novice.machine.hand_in_beam_s, 20.0);
  EXPECT_GT(sum_novice.machine.beam_while_moving_s, 1.0);
  EXPECT_LT(sum_novice.machine.views.count, sum_expert.machine.views.count);
  EXPECT_GT(sum_novice.t_s, sum_expert.t_s);
}

TEST(FluoroscopyOperator, ATargetThatIsNotClearIsFoundWorse) {
  const cases::Case scene = patient(cases::PatientPosition::supine);
  double clear_mm = 0.0, vague_mm = 0.0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    clear_mm += attempt(scene, "expert", seed).miss_mm;
    vague_mm += attempt(scene, "expert", seed, false).miss_mm;
  }
  EXPECT_GT(vague_mm, 1.1 * clear_mm) << clear_mm / 60 << " and " << vague_mm / 60 << " mm in the mean";
}

TEST(FluoroscopyOperator, SameSeedSameAttemptOtherSeedAnother) {
  const cases::Case scene = patient(cases::PatientPosition::supine);
  EXPECT_EQ(attempt(scene, "novice", 5).hash, attempt(scene, "novice", 5).hash);
  EXPECT_NE(attempt(scene, "novice", 5).hash, attempt(scene, "novice", 6).hash);
  // Where this changes, kOperatorVersion goes up, or kStepVersion.
  EXPECT_EQ(attempt(scene, "novice", 5).hash, 13062817393951068605ULL);
}

TEST(FluoroscopyOperator, ItsParametersAreData) {
  const auto custom =
      profile_from_json(R"({"hand_in_beam_share": 1, "pulse_rate_hz": 15, "collimator_open": 0.3})");
  ASSERT_TRUE(custom.has_value());
  EXPECT_EQ(custom->hand_in_beam_share, 1.0);
  EXPECT_EQ(custom->pulse_rate_hz, 15.0);
  EXPECT_EQ(custom->collimator_open, 0.3);
  for (const char* bad : {R"({"pulse_rate_hz": 1})", R"({"collimator_open": 0})", R"({"look_s": -1})"})
    EXPECT_EQ(profile_from_json(bad).error().code, "bad_operator") << bad;
}

TEST(PlanPuncture, UnderXrayKeepsToWhereAMachineCanLookAlong) {
  const PathLimits limits = path_limits(cases::Modality::xray, cases::PatientPosition::supine);
  EXPECT_EQ(limits.max_lao_deg, kBullsEyeLaoDeg);
  EXPECT_EQ(limits.max_cranial_deg, kBullsEyeCranialDeg);
  EXPECT_GE(path_limits(cases::Modality::mpr, cases::PatientPosition::supine).max_lao_deg, 180.0);
}

}  // namespace
}  // namespace seldinger::assessment
