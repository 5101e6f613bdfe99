// Tests of assessment/operators/scripted: what it does with what it sees, at pictures made up.
#include "assessment/operators/scripted.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "assessment/operators/probe_over.h"
#include "sim/base/hash.h"
#include "sim/engine/step.h"

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
    state.probe.origin_lps_mm = tick.inputs.probe.position_lps_mm;
    state.probe.axial = tick.inputs.probe.axis;
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

// What was drawn before operators knew of breath, or showed anything by deed, stays: attempts at still cases are
// those of before. Where these hashes change, kOperatorVersion goes up.
TEST(ScriptedOperator, AtAStillPatientActsAsBeforeItKnewOfBreath) {
  const auto shows = [](const Tick& tick) {
    return tick.inserted_mm > 2.0 && (tick.inserted_mm < 20.0 || tick.inserted_mm > 26.0) &&
           std::abs(tick.beyond_plane_mm) < 6.0;
  };
  std::vector<std::uint64_t> hashes;
  for (const bool across : {false, true})
    for (const char* name : {"novice", "intermediate", "expert"}) {
      std::uint64_t hash = 0;
      OperatorProfile only_says = *named_profile(name);
      only_says.shows_share = 0.0;
      for (const Tick& tick : ticks_of(only_says, across ? plan_across() : plan_in_plane(), {}, 11, shows)) {
        for (const cases::ToolPose* pose : {&tick.inputs.needle, &tick.inputs.probe})
          for (int axis = 0; axis < 3; ++axis)
            hash = base::hash_combine(base::hash_combine(hash, pose->position_lps_mm[axis]), pose->axis[axis]);
        const EventKind said =
            tick.inputs.event == EventKind::calipers_recorded ? EventKind::none : tick.inputs.event;
        hash = base::hash_combine(hash, static_cast<std::uint64_t>(said) * 2 + tick.inputs.fire);
      }
      hashes.push_back(hash);
    }
  const std::vector<std::uint64_t> before = {11573858680163442422ULL, 9241569844906584628ULL,
                                             16400829000048328202ULL, 17482833977871081420ULL,
                                             9217564390732547871ULL,  8099544976703744377ULL};
  EXPECT_EQ(hashes, before);
}

// How far the probe went along the picture each way before anything was said of it, and what was measured and
// planned.
struct Deeds {
  double least_mm = 0.0, most_mm = 0.0;
  std::optional<double> measured_mm, planned_mm;
  bool tested() const { return least_mm < -10.0 && most_mm > 10.0; }
};
Deeds deeds_of(const OperatorProfile& profile, const PuncturePlan& plan, std::uint64_t seed) {
  Deeds deeds;
  bool said = false;
  for (const Tick& tick :
       ticks_of(profile, plan, {}, seed, [](const Tick& one) { return one.inserted_mm > 0.0; })) {
    const double along_mm =
        glm::dot(tick.inputs.probe.position_lps_mm - plan.probe.position_lps_mm, plan.probe.side);
    said = said || tick.inputs.event == EventKind::probe_checked || tick.inputs.event == EventKind::note_plan;
    if (!said) {
      deeds.least_mm = std::min(deeds.least_mm, along_mm);
      deeds.most_mm = std::max(deeds.most_mm, along_mm);
    }
    const cases::Event event{tick.t_s, tick.inputs.event, 0.0, tick.inputs.event_tenths_mm};
    if (event.kind == EventKind::depth_measured) deeds.measured_mm = event.length_mm();
    if (event.kind == EventKind::note_plan) deeds.planned_mm = event.length_mm();
  }
  return deeds;
}

TEST(ScriptedOperator, ShowsByDeedAsOftenAsPlanted) {
  const PuncturePlan plan = plan_in_plane();
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Deeds deeds = deeds_of(*named_profile("expert"), plan, seed);
    EXPECT_TRUE(deeds.tested()) << deeds.least_mm << " to " << deeds.most_mm;
    ASSERT_TRUE(deeds.measured_mm && deeds.planned_mm);
    EXPECT_NEAR(*deeds.measured_mm, 50.0, 5.0) << "below the probe's face";
    EXPECT_NEAR(*deeds.planned_mm, plan.depth_mm, 5.0);
    OperatorProfile only_says = *named_profile("expert");
    only_says.shows_share = 0.0;
    const Deeds said = deeds_of(only_says, plan, seed);
    EXPECT_FALSE(said.tested());
    EXPECT_FALSE(said.measured_mm);
  }
  OperatorProfile novice = *named_profile("novice");
  novice.max_redirections = 0.0;
  constexpr int kTries = 150;
  int tested = 0, measured = 0;
  for (std::uint64_t seed = 0; seed < kTries; ++seed) {
    const Deeds deeds = deeds_of(novice, plan, seed);
    tested += deeds.tested() ? 1 : 0;
    measured += deeds.measured_mm ? 1 : 0;
  }
  const double share = novice.shows_share, most = 4.0 * std::sqrt(share * (1.0 - share) / kTries);
  EXPECT_NEAR(tested / double{kTries}, share, most);
  EXPECT_NEAR(measured / double{kTries}, share, most);
}

// Who breathes, and coughs at cough_s; pictures show everything below the skin. Nothing is in his way.
struct BreathTick {
  double t_s = 0.0, inserted_mm = 0.0;
  bool held = false, fires = false;
  EventKind said = EventKind::none;
};
std::vector<BreathTick> at_who_breathes(const OperatorProfile& profile, std::uint64_t seed, double cough_s = 1e9) {
  const PuncturePlan plan = plan_in_plane();
  ScriptedOperator person(profile, plan, {}, seed);
  cases::Case scene;
  scene.breathing = cases::Breathing{};
  scene.breathing->seed = seed;
  cases::State state;
  cases::FrameTruth frame;
  frame.target = true;
  std::vector<BreathTick> ticks;
  bool coughed = false;
  for (double next_s = 0.0; !person.done() && state.t_s < 200.0;) {
    const bool picture = state.t_s >= next_s;
    if (picture) next_s += kPictureS;
    frame.t_s = state.t_s;
    frame.needle_tip = !ticks.empty() && ticks.back().inserted_mm > 1.0;
    cases::Inputs inputs = person.act(state, picture ? &frame : nullptr, kTickS);
    const EventKind said = inputs.event;
    if (!coughed && state.t_s >= cough_s && inputs.event == EventKind::none) {
      inputs.event = EventKind::cough;
      coughed = true;
    }
    person.hear(inputs.event);
    engine::step(scene, inputs, kTickS, state);
    ticks.push_back({state.t_s, glm::dot(state.needle.tip_lps_mm - plan.entry_lps_mm, plan.direction),
                     state.breath.state.held >= 1.0 && state.breath.state.cough_s == 0.0, inputs.fire, said});
  }
  return ticks;
}
int times_asked(const std::vector<BreathTick>& ticks) {
  return static_cast<int>(std::count_if(ticks.begin(), ticks.end(), [](const BreathTick& tick) {
    return tick.said == EventKind::breath_hold_request;
  }));
}

TEST(ScriptedOperator, AnExpertPuncturesInAHeldBreath) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto ticks = at_who_breathes(*named_profile("expert"), seed);
    EXPECT_EQ(times_asked(ticks), 1) << seed;
    bool fired = false;
    for (const BreathTick& tick : ticks) {
      fired = fired || tick.fires;
      if (tick.inserted_mm > 2.0 && !fired) {
        ASSERT_TRUE(tick.held) << seed << " at " << tick.t_s;
      }
      if (tick.fires) {
        ASSERT_TRUE(tick.held) << seed;
      }
    }
    EXPECT_TRUE(fired) << seed;
  }
}

TEST(ScriptedOperator, AnExpertWaitsForALostBreathAndAsksAgain) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    // On the way in, as it goes without a cough.
    const auto undisturbed = at_who_breathes(*named_profile("expert"), seed);
    double cough_s = 0.0;
    for (const BreathTick& tick : undisturbed)
      if (cough_s == 0.0 && tick.inserted_mm > 10.0) cough_s = tick.t_s;
    const auto ticks = at_who_breathes(*named_profile("expert"), seed, cough_s);
    EXPECT_EQ(times_asked(ticks), 2) << seed;
    double deepest_mm = 0.0;
    bool fired = false;
    for (const BreathTick& tick : ticks) {
      fired = fired || tick.fires;
      if (fired) break;
      if (tick.held || tick.t_s < cough_s + 1.0)
        deepest_mm = std::max(deepest_mm, tick.inserted_mm);
      else
        EXPECT_LT(tick.inserted_mm, deepest_mm + 1.5) << seed << " went on at " << tick.t_s;  // its sway
    }
    EXPECT_TRUE(fired) << seed;
    const auto at_fire =
        std::find_if(ticks.begin(), ticks.end(), [](const BreathTick& tick) { return tick.fires; });
    EXPECT_TRUE(at_fire != ticks.end() && at_fire->held) << seed;
  }
}

TEST(ScriptedOperator, HowManyAskEarlyAndWaitIsAsPlanted) {
  for (const char* name : {"novice", "intermediate"}) {
    OperatorProfile profile = *named_profile(name);
    profile.skip_step_share = 0.0;
    constexpr int kTries = 120;
    int early = 0, held = 0;
    for (std::uint64_t seed = 1; seed <= kTries; ++seed) {
      const auto ticks = at_who_breathes(profile, seed);
      const auto said_at = std::find_if(ticks.begin(), ticks.end(), [](const BreathTick& tick) {
        return tick.said == EventKind::breath_hold_request;
      });
      const auto fired_at =
          std::find_if(ticks.begin(), ticks.end(), [](const BreathTick& tick) { return tick.fires; });
      ASSERT_NE(fired_at, ticks.end()) << seed;
      early += said_at != ticks.end() && said_at->inserted_mm < 0.0 ? 1 : 0;
      held += fired_at->held ? 1 : 0;
    }
    const auto near = [](int count, double share) {
      EXPECT_NEAR(count / double{kTries}, share, 4.0 * std::sqrt(share * (1.0 - share) / kTries));
    };
    near(early, profile.holds_breath_early_share);
    // Who waits fires in it; of the others those who asked so early that it was held by then, and did not use it
    // up.
    EXPECT_GE(held / double{kTries}, profile.waits_for_breath_share - 4.0 * std::sqrt(0.25 / kTries));
    EXPECT_LE(held / double{kTries},
              1.0 - (1.0 - profile.waits_for_breath_share) * (1.0 - profile.holds_breath_early_share) +
                  4.0 * std::sqrt(0.25 / kTries));
  }
}

TEST(ScriptedOperator, AimsAtATargetThatGaveWayWhereThePictureShowsIt) {
  // It is pushed 6 mm ahead, and 5 mm aside once the needle is in.
  const PuncturePlan plan = plan_in_plane();
  const glm::dvec3 moved_mm(5.0, 6.0, 0.0);
  OperatorProfile profile = *named_profile("expert");
  profile.target_error_mm = profile.aim_error_deg = profile.sway_mm = profile.tremor_mm = 0.0;
  for (const bool told : {false, true}) {
    ScriptedOperator person(profile, plan, {}, 5);
    cases::State state;
    cases::FrameTruth frame;
    frame.target = frame.needle_tip = true;
    glm::dvec3 end(0.0), before(0.0);
    while (!person.done() && state.t_s < 100.0) {
      state.t_s += kTickS;
      frame.t_s = state.t_s;
      const bool inside = state.needle.tip_lps_mm.y > -95.0;
      const cases::Inputs inputs = person.act(state, &frame, kTickS, told && inside ? moved_mm : glm::dvec3(0.0));
      before = state.needle.tip_lps_mm;
      state.needle.tip_lps_mm = inputs.needle.position_lps_mm;
      state.needle.direction = inputs.needle.axis;
      if (inputs.fire) end = state.needle.tip_lps_mm;
      if (state.t_s > 0.01) {
        EXPECT_LT(glm::distance(before, state.needle.tip_lps_mm), 1.0) << "no hand jumps, at " << state.t_s;
      }
    }
    EXPECT_NEAR(glm::distance(end, plan.target_lps_mm + moved_mm), told ? 0.0 : glm::length(moved_mm), 2.0) << told;
  }
}

}  // namespace
}  // namespace seldinger::assessment
