// Prints the chained state hash of every tick of two simulated attempts at a sphere-shaped patient, under a probe
// and under X-ray. Built several times with other compiler options (CMakeLists.txt); determinism_test compares what
// the builds print.
#include <cstdio>
#include <glm/geometric.hpp>

#include "assessment/operators/fluoroscopy.h"
#include "assessment/operators/scripted.h"
#include "sim/devices/virtual_device.h"
#include "sim/engine/step.h"
#include "tests/fixtures/meshes.h"

using namespace seldinger;

namespace {

// Prints the hashes and gives the last state.
cases::State under_probe(const cases::Case& scene, const assessment::PuncturePlan& plan) {
  assessment::ScriptedOperator person(*assessment::named_profile("novice"), plan, scene.instrument, 42);
  devices::VirtualDevice needle_arm, probe_arm;
  cases::State state;
  std::uint64_t hash = 0;
  for (int tick = 0; tick < 40'000 && !person.done(); ++tick) {
    cases::FrameTruth frame;
    frame.t_s = state.t_s;
    frame.needle_tip = (tick / 700) % 3 != 0;
    cases::Inputs inputs = person.act(state, tick % 33 == 0 ? &frame : nullptr, 0.001);
    inputs.needle = needle_arm.advance(inputs.needle, 0.001);
    inputs.probe = probe_arm.advance(inputs.probe, 0.001);
    engine::step(scene, inputs, 0.001, state);
    hash = cases::state_hash(state, hash);
    std::printf("%016llx\n", static_cast<unsigned long long>(hash));
  }
  return state;
}

cases::State under_xray(const cases::Case& scene, const assessment::PuncturePlan& plan) {
  assessment::FluoroscopyOperator person(*assessment::named_profile("novice"), plan, scene.instrument,
                                         scene.fluoroscope, scene.position, 42);
  devices::VirtualDevice needle_arm;
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
  scene.picture.modality = cases::Modality::xray;
  return under_xray(scene, plan).fire.fired && fired ? 0 : 1;
}
