// Prints the chained state hash of every tick of two simulated attempts at a sphere-shaped patient, under a probe
// and under X-ray, and of the forces on two hands. Built several times with other compiler options
// (CMakeLists.txt); determinism_test compares what the builds print.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "assessment/operators/fluoroscopy.h"
#include "assessment/operators/scripted.h"
#include "sim/base/hash.h"
#include "sim/devices/virtual_arm.h"
#include "sim/engine/moving_tissue.h"
#include "sim/engine/patient.h"
#include "sim/engine/step.h"
#include "sim/haptics/two_hands.h"
#include "tests/fixtures/meshes.h"

using namespace seldinger;

namespace {

// Prints the hashes and gives the last state.
cases::State under_probe(const cases::Case& scene, const assessment::PuncturePlan& plan) {
  assessment::ScriptedOperator person(*assessment::named_profile("novice"), plan, scene.instrument, 42);
  devices::VirtualArm needle_arm, probe_arm;
  const engine::Patient patient(scene);
  engine::PatientState memory;
  const engine::MovingTissue tissue(scene);
  const haptics::HandStates hands{};
  cases::State state;
  std::uint64_t hash = 0;
  for (int tick = 0; tick < 40'000 && !person.done(); ++tick) {
    cases::FrameTruth frame;
    frame.t_s = state.t_s;
    frame.needle_tip = (tick / 700) % 3 != 0;
    cases::Inputs inputs = person.act(state, tick % 33 == 0 ? &frame : nullptr, 0.001);
    inputs.needle = needle_arm.advance(inputs.needle, 0.001);
    inputs.probe = probe_arm.advance(inputs.probe, 0.001);
    if (tick == 500) inputs.event = cases::EventKind::breath_hold_request;
    engine::step(scene, inputs, 0.001, tissue.felt_by_needle(state, hands), state);
    hash = base::hash_combine(cases::state_hash(state, hash),
                              static_cast<std::uint64_t>(patient.advance(inputs, state, memory)));
    std::printf("%016llx\n", static_cast<unsigned long long>(hash));
  }
  return state;
}

cases::State under_xray(const cases::Case& scene, const assessment::PuncturePlan& plan) {
  assessment::FluoroscopyOperator person(*assessment::named_profile("novice"), plan, scene.instrument,
                                         scene.fluoroscope, scene.position, 42);
  devices::VirtualArm needle_arm;
  cases::State state;
  cases::ExposureReport report;
  assessment::PictureFix fix;
  bool new_frame = false;
  std::uint64_t hash = 0;
  for (int tick = 0; tick < 200'000 && !person.done(); ++tick) {
    cases::Inputs inputs = person.act(state, new_frame ? &fix : nullptr, 0.001);
    inputs.needle = needle_arm.advance(inputs.needle, 0.001);
    inputs.exposure = report;
    engine::step(scene, inputs, 0.001, state);
    hash = cases::state_hash(state, hash);
    std::printf("%016llx\n", static_cast<unsigned long long>(hash));
    new_frame = state.fluoroscopy.frame_due;
    if (!new_frame) continue;
    const auto frame = cases::beam_frame(scene.fluoroscope, state.fluoroscopy.arm, scene.position);
    fix = {true, true, true, cases::shadow_of(frame, state.needle.tip_lps_mm)->detector_mm,
           cases::shadow_of(frame, plan.target_lps_mm)->detector_mm};
    report = {state.fluoroscopy.frames, 0.013, 1.7, {71.0 + tick % 9, 33.0, 7.0}, tick % 2 == 0};
  }
  return state;
}

// A needle in and out with a sway, a probe that presses and slides; gives the most force.
double under_hands(cases::Case& scene, const assessment::PuncturePlan& plan) {
  scene.volume = volume::make_volume({70, 70, 70}, glm::dvec3(3.0), glm::dmat3(1.0), glm::dvec3(-103.5));
  for (int k = 0; k < 70; ++k)
    for (int j = 0; j < 70; ++j)
      for (int i = 0; i < 70; ++i) {
        const glm::dvec3 p = glm::dvec3(i, j, k) * 3.0 - 103.5;
        const double r2 = glm::dot(p, p);
        scene.classes.push_back(p.x > 40.0         ? volume::TissueClass::bone
                                : r2 < 60.0 * 60.0 ? volume::TissueClass::kidney
                                : r2 < 85.0 * 85.0 ? volume::TissueClass::soft_tissue
                                                   : volume::TissueClass::fat);
      }
  const haptics::HandSettings omni{*haptics::find_arm_model("omni"), 0.02};
  const haptics::TwoHands hands(scene, {omni, omni});
  haptics::HandStates states{};
  devices::VirtualArm needle_arm, probe_arm;
  std::uint64_t hash = 0;
  double most_n = 0.0;
  for (int tick = 0; tick < 12'000; ++tick) {
    const double way = std::abs(tick % 6000 - 3000) / 3000.0, sway = (tick * 7 % 901) / 900.0;
    haptics::HandInputs inputs;
    inputs[0].tool = haptics::Tool::probe;
    inputs[0].pose = probe_arm.advance(
        {plan.probe.position_lps_mm + (12.0 * sway - 2.0) * plan.probe.axis, plan.probe.axis, plan.probe.side},
        0.001);
    inputs[1].tool = haptics::Tool::needle;
    inputs[1].healthy = tick % 2500 > 20;
    inputs[1].delay_ticks = tick / 3000;
    inputs[1].pose = needle_arm.advance(
        {plan.target_lps_mm + glm::dvec3(sway, 0.0, 0.0) - (plan.depth_mm + 8.0) * way * plan.direction,
         plan.direction + glm::dvec3(0.0, 0.0, 0.02 * sway), plan.probe.side},
        0.001);
    for (const haptics::HandForce& force : hands.advance(inputs, 0.001, states)) {
      for (int axis = 0; axis < 3; ++axis) hash = base::hash_combine(hash, force.motor_n[axis]);
      most_n = std::max(most_n, glm::length(force.motor_n));
    }
    std::printf("%016llx\n", static_cast<unsigned long long>(hash));
  }
  return most_n;
}

}  // namespace

int main() {
  cases::Case scene;
  scene.skin = fixtures::sphere_mesh({0, 0, 0}, 100.0, 5);
  scene.skin_index = cases::MeshIndex(scene.skin);
  scene.lesions.push_back({{10.0, -40.0, 5.0}, 6.0, 20.0});
  scene.instrument.kind = cases::InstrumentKind::core;
  assessment::PuncturePlan plan;
  plan.target_lps_mm = scene.lesions[0].center_lps_mm;
  plan.direction = glm::normalize(glm::dvec3(0.1, 1.0, 0.2));
  plan.depth_mm = scene.skin_index.first_hit(plan.target_lps_mm, -plan.direction, 300.0)->distance_mm;
  plan.entry_lps_mm = plan.target_lps_mm - plan.direction * plan.depth_mm;
  plan.probe = {plan.entry_lps_mm + glm::dvec3(30, 0, 0), {-0.5, 0.8, 0.0}, {0.8, 0.5, 0.0}};
  const bool fired = under_probe(scene, plan).fire.fired;
  scene.breathing.emplace();
  under_probe(scene, plan);
  scene.breathing.reset();
  scene.picture.modality = cases::Modality::xray;
  const bool fired_there = under_xray(scene, plan).fire.fired;
  return under_hands(scene, plan) > 2.0 && fired_there && fired ? 0 : 1;
}
