// Tests of assessment/operators/scripted: what it does with what it sees, at pictures made up.
#include "assessment/operators/scripted.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "assessment/operators/probe_over.h"

namespace seldinger::assessment {
namespace {

using cases::EventKind;

constexpr double kTickS = 0.001, kPictureS = 0.02;

PuncturePlan plan_in_plane() {
  PuncturePlan plan;
  plan.target_lps_mm = {0, -40, 0};
  plan.entry_lps_mm = {0, -100, 0};
  plan.direction = {0, 1, 0};
  plan.depth_mm = 60.0;
  plan.probe = plan.probe_first = {{40, -90, 0}, {0, 1, 0}, {-1, 0, 0}};
  plan.tip_shows_from_mm = 3.0;
  plan.organ_from_mm = 25.0;
  return plan;
}

// The probe 30 mm above the target, across a needle that comes from 20 mm beside.
PuncturePlan plan_across() {
  PuncturePlan plan;
  plan.approach = cases::Approach::out_of_plane;
  plan.target_lps_mm = {0, -70, 0};
  plan.entry_lps_mm = {0, -100, -30};
  plan.direction = glm::normalize(plan.target_lps_mm - plan.entry_lps_mm);
  plan.depth_mm = glm::distance(plan.entry_lps_mm, plan.target_lps_mm);
  plan.probe = {{0, -100, 0}, {0, 1, 0}, {1, 0, 0}};
  plan.probe_first = plan.probe;
  plan.probe_first.position_lps_mm.z = -22.0;
  plan.tip_shows_from_mm = 6.0;
  return plan;
}

struct Tick {
  double t_s = 0.0, inserted_mm = 0.0, beyond_plane_mm = 0.0;
  bool tip_shown = false;
  cases::Inputs inputs;
};

// Until it is done or the time is over. The tip goes where the hand wants it, and a picture is what `shows` says.
std::vector<Tick> ticks_of(const OperatorProfile& profile, const PuncturePlan& plan,
                           const cases::Instrument& needle, std::uint64_t seed,
                           const std::function<bool(const Tick&)>& shows,
                           const std::function<void(cases::State&, bool shown)>& change = {},
                           double longest_s = 200.0) {
  ScriptedOperator person(profile, plan, needle, seed);
  std::vector<Tick> ticks;
  cases::State state;
  cases::FrameTruth frame;
  bool shown = false;
  for (double next_s = 0.0; !person.done() && state.t_s < longest_s;) {
    state.t_s += kTickS;
    const bool picture = state.t_s >= next_s;
    if (picture && !ticks.empty()) {
      shown = shows(ticks.back());
      next_s += kPictureS;
    }
    frame.t_s = state.t_s;
    frame.needle_tip = shown;
    frame.target = true;
    cases::State told = state;
    if (change) change(told, shown);
    Tick tick;
    tick.inputs = person.act(told, picture ? &frame : nullptr, kTickS);
    person.hear(tick.inputs.event);
    state.needle.tip_lps_mm = tick.inputs.needle.position_lps_mm;
    state.needle.direction = tick.inputs.needle.axis;
    tick.t_s = state.t_s;
    tick.inserted_mm = glm::dot(state.needle.tip_lps_mm - plan.entry_lps_mm, plan.direction);
    const glm::dvec3 normal = plane_normal(tick.inputs.probe);
    tick.beyond_plane_mm = glm::dot(state.needle.tip_lps_mm - tick.inputs.probe.position_lps_mm,
                                    glm::dot(normal, plan.direction) < 0.0 ? -normal : normal);
    tick.tip_shown = shown;
    ticks.push_back(tick);
  }
  return ticks;
}

TEST(ScriptedOperator, KnowsOfTheTipOnlyWhatPicturesShow) {
  // Whether what it is told of the tip is right makes no difference while no picture shows it.
  const auto shows = [](const Tick& tick) { return tick.inserted_mm > 3.0 && std::fmod(tick.t_s, 3.0) < 2.0; };
  for (const bool across : {false, true})
    for (const char* name : {"expert", "novice"}) {
      // The last sight is acted upon a reaction later: changed are ticks that no picture in that time has shown.
      double seen_s = -1.0, now_s = 0.0;
      const auto lie = [&](cases::State& state, bool shown) {
        now_s = state.t_s;
        if (shown) seen_s = now_s;
        if (now_s - seen_s > 1.0) state.needle.tip_lps_mm += glm::dvec3(5.0, 7.0, -9.0);
      };
      const auto plan = across ? plan_across() : plan_in_plane();
      const auto honest = ticks_of(*named_profile(name), plan, {}, 7, shows);
      const auto lied_to = ticks_of(*named_profile(name), plan, {}, 7, shows, lie);
      ASSERT_EQ(honest.size(), lied_to.size());
      for (std::size_t i = 0; i < honest.size(); ++i) {
        ASSERT_EQ(honest[i].inputs.needle.position_lps_mm, lied_to[i].inputs.needle.position_lps_mm) << i;
        ASSERT_EQ(honest[i].inputs.probe.position_lps_mm, lied_to[i].inputs.probe.position_lps_mm) << i;
      }
    }
}

TEST(ScriptedOperator, AnExpertStopsWhenTheTipIsGoneAndANoviceGoesOn) {
  const auto shows = [](const Tick& tick) { return tick.inserted_mm > 2.0 && tick.inserted_mm < 30.0; };
  double expert_mm = 0.0, novice_mm = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    for (const bool expert : {true, false}) {
      double farthest_mm = 0.0, lost_s = 0.0;
      for (const Tick& tick :
           ticks_of(*named_profile(expert ? "expert" : "novice"), plan_in_plane(), {}, seed, shows, {}, 100.0)) {
        if (tick.inserted_mm >= 30.0 && lost_s == 0.0) lost_s = tick.t_s;
        if (lost_s > 0.0 && tick.t_s < lost_s + 2.0) farthest_mm = std::max(farthest_mm, tick.inserted_mm - 30.0);
      }
      EXPECT_TRUE(!expert || farthest_mm < 5.0) << "a reaction at its speed, seed " << seed;
      (expert ? expert_mm : novice_mm) += farthest_mm / 10.0;
    }
  EXPECT_GT(novice_mm, 2.0 * expert_mm);
}

TEST(ScriptedOperator, CorrectsWithinTheOrgan) {
  OperatorProfile profile = *named_profile("expert");
  profile.target_error_mm = 6.0;  // so that there is something to correct
  profile.accept_miss_mm = 0.5;
  profile.checks_aim_share = 0.0;
  const auto plan = plan_in_plane();
  for (const bool leaves : {false, true}) {
    profile.leaves_organ_share = leaves ? 1.0 : 0.0;
    int back = 0, left = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const auto ticks = ticks_of(profile, plan, {}, seed, [](const Tick& tick) { return tick.inserted_mm > 0.0; });
      double deepest_mm = 0.0, lowest_mm = 1e9;
      for (const Tick& tick : ticks) {
        if (tick.inputs.fire) break;
        deepest_mm = std::max(deepest_mm, tick.inserted_mm);
        if (deepest_mm > plan.organ_from_mm + 10.0) lowest_mm = std::min(lowest_mm, tick.inserted_mm);
      }
      back += deepest_mm - lowest_mm > 5.0 ? 1 : 0;
      left += lowest_mm < plan.organ_from_mm ? 1 : 0;
    }
    EXPECT_GT(back, 5) << "it did correct";
    EXPECT_EQ(left > 0, leaves);
  }
}

TEST(ScriptedOperator, OutOfPlaneThePlaneGoesFirstAndTheTipFollows) {
  constexpr double kSliceMm = 1.5;
  const auto shows = [](const Tick& tick) {
    return tick.inserted_mm > 0.0 && std::abs(tick.beyond_plane_mm) <= kSliceMm;
  };
  double expert_mm = 0.0, novice_mm = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    for (const bool expert : {true, false}) {
      const auto ticks = ticks_of(*named_profile(expert ? "expert" : "novice"), plan_across(), {}, seed, shows);
      const auto fired =
          std::find_if(ticks.begin(), ticks.end(), [](const Tick& tick) { return tick.inputs.fire; });
      ASSERT_NE(fired, ticks.end()) << seed;
      double beyond_mm = 0.0;
      for (auto tick = ticks.begin() + 1; tick != fired; ++tick) {
        if (tick->inserted_mm > 0.0 && tick->beyond_plane_mm > 3.0)
          beyond_mm += std::max(0.0, tick->inserted_mm - (tick - 1)->inserted_mm);
      }
      if (expert) {
        EXPECT_LT(beyond_mm, 3.0) << seed;
        EXPECT_LT(std::abs(fired->inserted_mm - plan_across().depth_mm), 6.0) << seed;
      }
      (expert ? expert_mm : novice_mm) += beyond_mm / 10.0;
    }
  EXPECT_GT(novice_mm, expert_mm + 1.0);
}

TEST(ScriptedOperator, ACoreNeedleIsTakenOutWhole) {
  cases::Instrument core;
  core.kind = cases::InstrumentKind::core;
  const auto ticks = ticks_of(*named_profile("expert"), plan_in_plane(), core, 3,
                              [](const Tick& tick) { return tick.inserted_mm > 0.0; });
  ASSERT_FALSE(ticks.empty());
  EXPECT_LT(ticks.back().inserted_mm + core.throw_mm, -5.0) << "its thrown tip too";
  EXPECT_LT(ticks.back().t_s, 60.0);
}

}  // namespace
}  // namespace seldinger::assessment
