// Prints the chained state hash of every tick of a simulated attempt at a sphere-shaped patient. Built several
// times with other compiler options (CMakeLists.txt); determinism_test compares what the builds print.
#include <cstdio>
#include <glm/geometric.hpp>

#include "assessment/operators/scripted.h"
#include "sim/devices/virtual_device.h"
#include "sim/engine/step.h"
#include "tests/fixtures/meshes.h"

using namespace seldinger;

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
  return state.fire.fired ? 0 : 1;
}
