// Tests of sim/engine/step.
#include "sim/engine/step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "sim/base/rng.h"
#include "tests/fixtures/allocations.h"
#include "tests/fixtures/meshes.h"

namespace seldinger::engine {
namespace {

cases::Case sphere_case() {
  cases::Case scene;
  scene.skin = fixtures::sphere_mesh({0, 0, 0}, 100.0, 5);
  scene.skin_index = cases::MeshIndex(scene.skin);
  return scene;
}

cases::Inputs at(double y_mm) {
  cases::Inputs inputs;
  inputs.needle = {{0.5, y_mm, 0.3}, {0, 1, 0}, {1, 0, 0}};
  inputs.probe = {{0, -100, 0}, {0, 1, 0}, {1, 0, 0}};
  return inputs;
}

TEST(Step, MakesNoAllocation) {
  const cases::Case scene = sphere_case();
  cases::State state;
  const long before = fixtures::allocations();
  int* volatile one = new int(1);  // volatile: the optimiser may not leave it out
  delete one;
  ASSERT_EQ(fixtures::allocations(), before + 1) << "the counter counts";
  const long start = fixtures::allocations();
  for (int i = 0; i < 1000; ++i) {
    cases::Inputs inputs = at(-120.0 + i * 0.1);
    inputs.fire = i > 900;
    step(scene, inputs, 0.001, state);
  }
  EXPECT_EQ(fixtures::allocations(), start);
  EXPECT_TRUE(state.fire.fired);
}

TEST(Step, IsPure) {
  const cases::Case scene = sphere_case();
  base::Rng rng(1);
  cases::State a, b;
  for (int i = 0; i < 500; ++i) {
    cases::Inputs inputs = at(-120.0 + 60.0 * rng.uniform());
    step(scene, inputs, 0.001, a);
    cases::State copy = b;
    step(scene, inputs, 0.001, copy);  // a call thrown away changes nothing
    step(scene, inputs, 0.001, b);
    ASSERT_EQ(cases::state_hash(a, 0), cases::state_hash(b, 0)) << i;
  }
}

TEST(Step, TheConsoleStandsAsItWasTurnedLast) {
  cases::Case scene = sphere_case();
  cases::State state;
  cases::Inputs inputs = at(-120.0);
  step(scene, inputs, 0.001, state);
  EXPECT_EQ(state.probe.console, cases::ConsoleSetting{});
  inputs.console = {90.0, 40.0, 2.5, -3.0, 200.0, 12.0, -20.0, 0.3, 0.7};
  step(scene, inputs, 0.001, state);
  EXPECT_EQ(state.probe.console, inputs.console);
  const cases::ConsoleSetting before = inputs.console;
  constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
  inputs.console = {kNotANumber, std::numeric_limits<double>::infinity(),
                    3.0,         kNotANumber,
                    kNotANumber, kNotANumber,
                    kNotANumber, kNotANumber,
                    kNotANumber};
  step(scene, inputs, 0.001, state);
  cases::ConsoleSetting expected = before;
  expected.frequency_mhz = 3.0;
  EXPECT_EQ(state.probe.console, expected);
  // Nothing of it under a fluoroscope.
  scene.picture.modality = cases::Modality::xray;
  cases::State room;
  inputs.console = before;
  step(scene, inputs, 0.001, room);
  EXPECT_EQ(room.probe.console, cases::ConsoleSetting{});
}

TEST(Step, InsertedLengthIsTheWayFromTheEntry) {
  const cases::Case scene = sphere_case();
  cases::State state;
  for (double y = -110.0; y <= -60.0; y += 0.25) step(scene, at(y), 0.001, state);
  EXPECT_TRUE(state.needle.skin.in_body);
  EXPECT_NEAR(state.needle.inserted_mm, 40.0, 0.1);
  EXPECT_NEAR(state.needle.skin.depth_mm, 40.0, 0.1);
  EXPECT_NEAR(state.t_s, 0.201, 1e-12);
}

TEST(Step, ACoreNeedleIsThrownWhenFiredAndTheEndpointIsBefore) {
  cases::Case scene = sphere_case();
  scene.instrument.kind = cases::InstrumentKind::core;
  cases::State state;
  for (double y = -110.0; y <= -60.0; y += 0.25) step(scene, at(y), 0.001, state);
  cases::Inputs inputs = at(-60.0);
  inputs.fire = true;
  step(scene, inputs, 0.001, state);
  EXPECT_TRUE(state.fire.fired);
  EXPECT_NEAR(state.fire.tip_lps_mm.y, -60.0, 1e-12);
  EXPECT_NEAR(state.needle.tip_lps_mm.y, -60.0 + scene.instrument.throw_mm, 1e-12);
  const double t_s = state.fire.t_s;
  step(scene, inputs, 0.001, state);
  EXPECT_EQ(state.fire.t_s, t_s) << "the first trigger is the endpoint";
}

TEST(Step, AnAccessNeedleStaysWhereItIs) {
  const cases::Case scene = sphere_case();
  cases::State state;
  step(scene, at(-60.0), 0.001, state);
  cases::Inputs inputs = at(-60.0);
  inputs.fire = true;
  step(scene, inputs, 0.001, state);
  EXPECT_EQ(state.needle.tip_lps_mm, state.fire.tip_lps_mm);
}

TEST(Step, ADeviceThatSaysNonsenseLeavesThePoseAsItWas) {
  const cases::Case scene = sphere_case();
  cases::State state;
  step(scene, at(-90.0), 0.001, state);
  const cases::State before = state;
  cases::Inputs inputs;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  inputs.needle = {glm::dvec3(nan), glm::dvec3(0.0), glm::dvec3(nan)};
  inputs.probe = {glm::dvec3(nan), glm::dvec3(nan), glm::dvec3(0.0)};
  step(scene, inputs, 0.001, state);
  EXPECT_EQ(state.needle.tip_lps_mm, before.needle.tip_lps_mm);
  EXPECT_EQ(state.needle.direction, before.needle.direction);
  EXPECT_EQ(state.probe.origin_lps_mm, before.probe.origin_lps_mm);
  EXPECT_EQ(state.probe.axial, before.probe.axial);
  EXPECT_NEAR(glm::length(state.probe.lateral - before.probe.lateral), 0.0, 1e-12);
}

TEST(Step, ProbeAxesStayPerpendicularUnits) {
  const cases::Case scene = sphere_case();
  base::Rng rng(3);
  cases::State state;
  for (int i = 0; i < 1000; ++i) {
    cases::Inputs inputs = at(-120.0);
    inputs.probe.axis = {rng.normal(), rng.normal(), rng.normal()};
    inputs.probe.side = i % 10 == 0 ? inputs.probe.axis : glm::dvec3(rng.normal(), rng.normal(), rng.normal());
    step(scene, inputs, 0.001, state);
    EXPECT_NEAR(glm::length(state.probe.axial), 1.0, 1e-12);
    EXPECT_NEAR(glm::length(state.probe.lateral), 1.0, 1e-12);
    EXPECT_NEAR(glm::dot(state.probe.axial, state.probe.lateral), 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace seldinger::engine
