// Each field of the state counts in its hash.
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <iterator>

#include "sim/case/state.h"

namespace seldinger::cases {
namespace {

TEST(StateHash, EveryFieldOfAFluoroscopeInUseCounts) {
  State state;
  state.fluoroscopy.in_use = true;
  const std::uint64_t before = state_hash(state, 0);
  EXPECT_NE(before, state_hash(State{}, 0));
  const auto changes = [&](const std::function<void(FluoroscopyState&)>& change) {
    State other = state;
    change(other.fluoroscopy);
    return state_hash(other, 0) != before;
  };
  using F = FluoroscopyState;
  double F::*const numbers[] = {
      &F::wait_s,         &F::frame_s,       &F::fluoroscopy_time_s, &F::beam_while_moving_s,
      &F::hand_in_beam_s, &F::air_kerma_mgy, &F::dap_mgy_cm2,        &F::collimated_s};
  for (std::size_t i = 0; i < std::size(numbers); ++i)
    EXPECT_TRUE(changes([number = numbers[i]](F& f) { f.*number += 1.0; })) << "number " << i;
  bool F::*const flags[] = {&F::arm_moving, &F::beam_on, &F::frame_due, &F::live, &F::hand_away};
  for (std::size_t i = 0; i < std::size(flags); ++i)
    EXPECT_TRUE(changes([flag = flags[i]](F& f) { f.*flag = !(f.*flag); })) << "flag " << i;
  EXPECT_TRUE(changes([](F& f) { f.arm.lao_deg = 1; }));
  EXPECT_TRUE(changes([](F& f) { f.arm.cranial_deg = 1; }));
  EXPECT_TRUE(changes([](F& f) { f.arm.sid_mm = 1; }));
  for (int axis = 0; axis < 3; ++axis) EXPECT_TRUE(changes([axis](F& f) { f.arm.isocentre_lps_mm[axis] = 1; }));
  EXPECT_TRUE(changes([](F& f) { f.frames = 1; }));
  EXPECT_TRUE(changes([](F& f) { f.reported = 1; }));
  EXPECT_TRUE(changes([](F& f) { f.pulse_rate = 2; }));
  EXPECT_TRUE(changes([](F& f) { f.magnification = 2; }));
  EXPECT_TRUE(changes([](F& f) { f.collimator.open_u = 0.5; }));
  EXPECT_TRUE(changes([](F& f) { f.collimator.open_v = 0.5; }));
  for (Technique F::*const technique : {&F::technique, &F::last_technique}) {
    EXPECT_TRUE(changes([technique](F& f) { (f.*technique).kv = 1; }));
    EXPECT_TRUE(changes([technique](F& f) { (f.*technique).ma = 1; }));
    EXPECT_TRUE(changes([technique](F& f) { (f.*technique).pulse_ms = 1; }));
  }
  EXPECT_TRUE(changes([](F& f) { f.views.count = 1; }));
  EXPECT_TRUE(changes([](F& f) { f.views.widest_deg = 1; }));
  state.fluoroscopy.views.count = 2;
  const std::uint64_t with_views = state_hash(state, 0);
  state.fluoroscopy.views.lao_deg[1] = 1;
  EXPECT_NE(state_hash(state, 0), with_views);
  state.fluoroscopy.views.lao_deg[1] = 0;
  state.fluoroscopy.views.cranial_deg[1] = 1;
  EXPECT_NE(state_hash(state, 0), with_views);
}

TEST(StateHash, EveryFieldOfAConsoleThatIsTurnedCounts) {
  State state;
  state.probe.console = {90.0, 40.0, 2.5, -3.0};
  const std::uint64_t before = state_hash(state, 0);
  using C = ConsoleSetting;
  for (double C::*const number : {&C::depth_mm, &C::focus_mm, &C::frequency_mhz, &C::slice_mm, &C::colour_mm_s,
                                  &C::compound_deg, &C::lean_deg, &C::box_across, &C::box_down}) {
    State other = state;
    other.probe.console.*number += 1.0;
    EXPECT_NE(state_hash(other, 0), before);
  }
}

TEST(StateHash, EveryFieldCounts) {
  State state;
  const std::uint64_t before = state_hash(state, 0);
  EXPECT_NE(before, state_hash(state, 1));
  const auto changes = [&](auto&& change) {
    State other;
    change(other);
    return state_hash(other, 0) != before;
  };
  EXPECT_TRUE(changes([](State& s) { s.tick = 1; }));
  EXPECT_TRUE(changes([](State& s) { s.t_s = 1; }));
  EXPECT_TRUE(changes([](State& s) { s.needle.tip_lps_mm.z = 1; }));
  EXPECT_TRUE(changes([](State& s) { s.needle.direction.x = 1; }));
  EXPECT_TRUE(changes([](State& s) { s.needle.inserted_mm = 1; }));
  EXPECT_TRUE(changes([](State& s) { s.needle.skin.tip_lps_mm.y = 1; }));
  EXPECT_TRUE(changes([](State& s) { s.needle.skin.depth_mm = 1; }));
  EXPECT_TRUE(changes([](State& s) { s.needle.skin.asked_lps_mm.y = 1; }));
  EXPECT_TRUE(changes([](State& s) { s.needle.skin.triangle = 1; }));
  EXPECT_TRUE(changes([](State& s) { s.needle.skin.geometric_inside = true; }));
  EXPECT_TRUE(changes([](State& s) { s.needle.skin.in_body = true; }));
  EXPECT_TRUE(changes([](State& s) { s.needle.skin.entry_lps_mm.x = 1; }));
  EXPECT_TRUE(changes([](State& s) { s.probe.origin_lps_mm.x = 1; }));
  EXPECT_TRUE(changes([](State& s) { s.probe.axial.x = 1; }));
  EXPECT_TRUE(changes([](State& s) { s.probe.lateral.y = 1; }));
  EXPECT_TRUE(changes([](State& s) { s.probe.frozen = true; }));
  EXPECT_TRUE(changes([](State& s) { s.probe.console.depth_mm = 90; }));
  EXPECT_TRUE(changes([](State& s) { s.probe.console.focus_mm = 40; }));
  EXPECT_TRUE(changes([](State& s) { s.probe.console.frequency_mhz = 2.5; }));
  EXPECT_TRUE(changes([](State& s) { s.probe.console.slice_mm = -3; }));
  EXPECT_TRUE(changes([](State& s) { s.probe.console.colour_mm_s = 200; }));
  EXPECT_TRUE(changes([](State& s) { s.probe.console.compound_deg = 12; }));
  EXPECT_TRUE(changes([](State& s) { s.probe.console.lean_deg = 20; }));
  EXPECT_TRUE(changes([](State& s) { s.probe.console.box_across = 0.3; }));
  EXPECT_TRUE(changes([](State& s) { s.probe.console.box_down = 0.7; }));
  EXPECT_TRUE(changes([](State& s) { s.fire.fired = true; }));
  EXPECT_TRUE(changes([](State& s) { s.fire.t_s = 1; }));
  EXPECT_TRUE(changes([](State& s) { s.fire.tip_lps_mm.x = 1; }));
  EXPECT_TRUE(changes([](State& s) { s.fire.direction.x = 1; }));
}

}  // namespace
}  // namespace seldinger::cases
