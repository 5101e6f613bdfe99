// Tests of sim/engine/tick and tick_state: an attempt is in one plain value, and goes on from what was saved of it.
#include "sim/engine/tick.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "sim/base/hash.h"
#include "sim/engine/saved_fields.h"
#include "sim/engine/step.h"
#include "sim/engine/tick_state_fields.h"
#include "tests/fixtures/allocations.h"
#include "tests/fixtures/ball_case.h"

namespace seldinger::engine {
namespace {

enum class Tissue { still, moving };

// A ball of fat around soft tissue (by its HU the softest) around kidney, with bone on its left side.
cases::Case ball(cases::Modality modality, Tissue tissue) {
  cases::Case scene =
      fixtures::ball_case({.voxels = 70, .voxel_mm = 3.0, .radius_mm = 100.0, .hu = -1000.0, .skin_levels = 5});
  for (int k = 0; k < 70; ++k)
    for (int j = 0; j < 70; ++j)
      for (int i = 0; i < 70; ++i) {
        const glm::dvec3 p = glm::dvec3(i, j, k) * 3.0 - 103.5;
        const double r = glm::length(p);
        scene.classes.push_back(p.x > 40.0 ? volume::TissueClass::bone
                                : r < 60.0 ? volume::TissueClass::kidney
                                : r < 85.0 ? volume::TissueClass::soft_tissue
                                           : volume::TissueClass::fat);
      }
  scene.picture.modality = modality;
  scene.instrument.kind = cases::InstrumentKind::core;
  if (tissue == Tissue::moving) {
    scene.breathing.emplace();
    scene.yields = true;
  }
  return scene;
}

// What hands do in a tick: a needle in and out with a sway, a probe that presses, and somebody who speaks.
cases::Inputs hands_at(std::uint64_t tick) {
  const double way = std::abs(static_cast<double>(tick % 4000) - 2000.0) / 2000.0;
  const double sway = static_cast<double>(tick * 7 % 901) / 900.0;
  cases::Inputs inputs;
  inputs.needle = {{sway, -40.0 - 75.0 * way, 2.0}, {0.02 * sway, 1.0, 0.0}, {1, 0, 0}};
  inputs.probe = {{-30.0 - sway, -100.0 + 9.0 * sway, 0.0}, {0.1, 1.0, 0.0}, {0, 0, 1}};
  inputs.fire = tick == 2900;
  inputs.console.depth_mm = tick > 1000 ? 120.0 : 0.0;
  if (tick == 300) inputs.event = cases::EventKind::anaesthetic;
  if (tick == 700) inputs.event = cases::EventKind::breath_hold_request;
  inputs.fluoroscope.pedal = tick % 500 < 200;
  inputs.fluoroscope.lao_speed = tick % 900 < 300 ? 0.5 : 0.0;
  inputs.fluoroscope.hand_away = tick % 1000 > 950;
  inputs.exposure = {static_cast<std::uint32_t>(tick / 80), 0.013, 1.7, {71.0, 33.0, 7.0}, tick % 160 < 80};
  return inputs;
}

const std::vector<cases::Event> kScenario = {{0.5, cases::EventKind::cough}, {2.5, cases::EventKind::bleeding}};

cases::RecordedTick turn(const Tick& tick, TickState& now) {
  cases::Inputs inputs = hands_at(now.state.tick);
  Scenario(kScenario).add_to(inputs, now.state.t_s, now.happened);
  return tick.advance_hands(inputs, {}, now);
}

// Which bytes of a TickState belong to a number of one of its fields; what is left lies between them. That no field
// is left out, the list of fields says by itself: else it does not compile.
struct Numbers {
  const TickState* whole;
  std::vector<bool> bytes = std::vector<bool>(sizeof(TickState), false);
  template <typename T>
  void number(const T& value) {
    const auto offset = reinterpret_cast<const char*>(&value) - reinterpret_cast<const char*>(whole);
    if (offset < 0 || offset >= static_cast<std::ptrdiff_t>(sizeof(TickState))) return;  // whether there is a force
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      EXPECT_FALSE(bytes[static_cast<std::size_t>(offset) + i]) << "twice";
      bytes[static_cast<std::size_t>(offset) + i] = true;
    }
  }
};

std::vector<unsigned char> bytes_of(const TickState& now) {
  std::vector<unsigned char> bytes(sizeof(TickState));
  std::memcpy(bytes.data(), static_cast<const void*>(&now), sizeof(TickState));
  return bytes;
}

std::size_t differing(const TickState& a, const TickState& b, const std::vector<bool>& fields) {
  const auto left = bytes_of(a), right = bytes_of(b);
  std::size_t count = 0;
  for (std::size_t i = 0; i < fields.size(); ++i) count += fields[i] && left[i] != right[i] ? 1 : 0;
  return count;
}

TickState after(const Tick& tick, int ticks) {
  TickState now;
  for (int i = 0; i < ticks; ++i) turn(tick, now);
  return now;
}

TEST(TickState, EveryByteOfEveryFieldIsSavedRestoredAndHashed) {
  const cases::Case scene = ball(cases::Modality::xray, Tissue::moving);
  const TickState now = after(Tick(scene), 2950);
  ASSERT_TRUE(now.force && now.state.fire.fired && now.capsules > 0 && now.happened == 2);
  Numbers numbers{&now};
  fields::Walk<Numbers>{numbers}(now);
  const std::vector<bool>& fields = numbers.bytes;
  ASSERT_GT(std::count(fields.begin(), fields.end(), true), 7000) << "most of it is numbers";
  const std::vector<std::byte> kept = saved(now);
  const std::uint64_t hash = tick_state_hash(now);
  int refused = 0;
  for (std::size_t i = 0; i < sizeof(TickState); ++i) {
    if (!fields[i]) continue;
    std::vector<unsigned char> bytes = bytes_of(now);
    bytes[i] = static_cast<unsigned char>(bytes[i] ^ 1U);  // a truth value stays one
    TickState other;
    std::memcpy(static_cast<void*>(&other), bytes.data(), sizeof(TickState));
    EXPECT_NE(saved(other), kept) << "byte " << i << " of a TickState is not saved";
    EXPECT_NE(tick_state_hash(other), hash) << "byte " << i << " of a TickState is not hashed";
    const auto back = restored(saved(other));
    if (!back) {
      ++refused;  // an index that is none
      EXPECT_EQ(back.error().code, "damaged");
      continue;
    }
    EXPECT_EQ(differing(*back, other, fields), 0U) << "byte " << i << " of a TickState is not restored";
  }
  EXPECT_LT(refused, 200) << "few bytes are parts of an index";
  TickState unfelt = now;
  unfelt.force.reset();
  EXPECT_NE(saved(unfelt), kept);
  EXPECT_NE(tick_state_hash(unfelt), hash);
}

TEST(TickState, EveryNumberComesBackBitForBit) {
  TickState now;
  now.state.needle.tip_lps_mm = {-0.0, std::nan("7"), -INFINITY};
  now.hands[0].probe.bone_mm = INFINITY;
  now.capsule_n = 5e-324;
  now.hash = ~std::uint64_t{0};
  const auto back = restored(saved(now));
  ASSERT_TRUE(back);
  const auto is = [](double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; };
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_TRUE(is(back->state.needle.tip_lps_mm[axis], now.state.needle.tip_lps_mm[axis])) << axis;
  EXPECT_EQ(back->hands[0].probe.bone_mm, INFINITY);
  EXPECT_EQ(back->capsule_n, 5e-324);
  EXPECT_EQ(back->hash, now.hash);
  EXPECT_FALSE(back->force);
  EXPECT_EQ(tick_state_hash(*back), tick_state_hash(now));
  TickState zero = now;
  zero.state.needle.tip_lps_mm.x = 0.0;
  EXPECT_NE(tick_state_hash(zero), tick_state_hash(now)) << "not even the sign of a zero is lost";
}

TEST(TickState, WhatIsNoSavedStateIsRefused) {
  const cases::Case scene = ball(cases::Modality::mpr, Tissue::still);
  const std::vector<std::byte> kept = saved(after(Tick(scene), 100));
  const auto refusal = [](std::span<const std::byte> bytes) {
    const auto back = restored(bytes);
    return back ? std::string() : back.error().code;
  };
  ASSERT_EQ(refusal(kept), "");
  for (std::size_t size = 0; size < kept.size(); ++size)
    ASSERT_EQ(refusal(std::span(kept).first(size)), "damaged") << size << " bytes of " << kept.size();
  for (std::size_t i = 0; i < kept.size(); i += 3) {
    std::vector<std::byte> other = kept;
    other[i] ^= std::byte{0x40};
    ASSERT_EQ(refusal(other), "damaged") << "byte " << i;
  }
  std::vector<std::byte> longer = kept;
  longer.push_back(std::byte{0});
  EXPECT_EQ(refusal(longer), "damaged");
  const auto sealed = [](std::vector<std::byte> bytes) {
    bytes.resize(bytes.size() - sizeof(std::uint64_t));
    const std::uint64_t sum = base::hash_bytes(bytes);
    const auto* from = reinterpret_cast<const std::byte*>(&sum);
    bytes.insert(bytes.end(), from, from + sizeof sum);
    return bytes;
  };
  for (const std::size_t version : {8U, 12U}) {
    std::vector<std::byte> other = kept;
    other[version] = std::byte{99};
    EXPECT_EQ(refusal(sealed(other)), "state_version");
  }
  std::vector<std::byte> cut = kept;
  cut.erase(cut.begin() + 500);
  EXPECT_EQ(refusal(sealed(cut)), "damaged");
  TickState wrong;
  wrong.hands[1].needle.path.count = haptics::kMostNeedleLayers + 1;
  EXPECT_EQ(refusal(saved(wrong)), "damaged");
  wrong = {};
  wrong.displacement.breath_end = 17;
  EXPECT_EQ(refusal(saved(wrong)), "damaged");
  wrong = {};
  wrong.state.fluoroscopy.pulse_rate = 3;
  EXPECT_EQ(refusal(saved(wrong)), "damaged");
}

class GoesOn : public testing::TestWithParam<std::tuple<cases::Modality, Tissue>> {};

// In the middle of a push, of a held breath, of a pulse, before and after the shot.
TEST_P(GoesOn, BitForBitFromWhatWasSaved) {
  const cases::Case scene = ball(std::get<0>(GetParam()), std::get<1>(GetParam()));
  const Tick tick(scene);
  constexpr int kTicks = 4000;
  const std::vector<int> cuts = {1, 337, 1234, 2899, 2900, 3600};
  TickState now;
  std::vector<std::vector<std::byte>> kept;
  std::vector<cases::RecordedTick> made;
  for (int i = 0; i < kTicks; ++i) {
    if (std::find(cuts.begin(), cuts.end(), i) != cuts.end()) kept.push_back(saved(now));
    made.push_back(turn(tick, now));
  }
  EXPECT_GT(now.capsules, 0U) << "there is something to forget";
  EXPECT_EQ(tissue::count_sources(now.displacement) > 0, std::get<1>(GetParam()) == Tissue::moving);
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    auto again = restored(kept[c]);
    ASSERT_TRUE(again);
    const Tick anew(scene);
    for (int i = cuts[c]; i < kTicks; ++i) {
      const cases::RecordedTick one = turn(anew, *again);
      const cases::RecordedTick& then = made[static_cast<std::size_t>(i)];
      ASSERT_EQ(one.hash, then.hash) << "tick " << i << " after a cut at " << cuts[c];
      ASSERT_TRUE(one.pose == then.pose && one.force == then.force && one.endpoint == then.endpoint &&
                  one.reaction == then.reaction && one.inputs.event == then.inputs.event)
          << "tick " << i << " after a cut at " << cuts[c];
    }
    EXPECT_EQ(tick_state_hash(*again), tick_state_hash(now)) << "after a cut at " << cuts[c];
    EXPECT_EQ(saved(*again), saved(now));
  }
}

INSTANTIATE_TEST_SUITE_P(AllModalities, GoesOn,
                         testing::Combine(testing::Values(cases::Modality::mpr, cases::Modality::ultrasound,
                                                          cases::Modality::xray),
                                          testing::Values(Tissue::still, Tissue::moving)));

// Taken up outside alone, left where its stylet is drawn in tissue, and in the forces from then on; of a needle
// that is no core needle the same words are its own stylet's.
TEST(Tick, ACoreNeedlesIntroducerIsTakenUpAndStays) {
  using haptics::Introducer;
  const auto course = [](cases::InstrumentKind kind, std::vector<cases::Event> said) {
    cases::Case scene = ball(cases::Modality::xray, Tissue::still);
    scene.instrument.kind = kind;
    const Tick tick(scene);
    TickState now;
    std::vector<Introducer> held;
    double most_n = 0.0;
    for (int i = 0; i < 2950; ++i) {
      cases::Inputs inputs = hands_at(now.state.tick);
      Scenario(said).add_to(inputs, now.state.t_s, now.happened);
      tick.advance_hands(inputs, {}, now);
      if (held.empty() || held.back() != now.introducer) held.push_back(now.introducer);
      most_n = std::max(most_n, now.force->needle_axial_n);
    }
    return std::pair(held, most_n);
  };
  using Held = std::vector<Introducer>;
  const auto bare = course(cases::InstrumentKind::core, {});
  const auto closed = course(cases::InstrumentKind::core, {{0.0, cases::EventKind::stylet_in}});
  EXPECT_EQ(closed.first, Held{Introducer::closed});
  EXPECT_GT(closed.second, 1.1 * bare.second) << "it is wider";
  EXPECT_EQ(course(cases::InstrumentKind::core, {{1.0, cases::EventKind::stylet_in}}).first, Held{Introducer::none})
      << "the needle is in tissue";
  EXPECT_EQ(
      course(cases::InstrumentKind::core, {{0.0, cases::EventKind::stylet_in}, {1.9, cases::EventKind::stylet_out}})
          .first,
      (Held{Introducer::closed, Introducer::open}));
  const auto access = course(cases::InstrumentKind::access, {{0.0, cases::EventKind::stylet_in}});
  EXPECT_EQ(access.first, Held{Introducer::none});
  EXPECT_EQ(access.second, bare.second);
}

// Drawn out of its introducer, the needle finds it again in the same hole; in beside it, it has left it.
TEST(Tick, AnIntroducerIsLeftForAnotherHole) {
  const std::vector<cases::Event> said = {{0.0, cases::EventKind::stylet_in}, {1.9, cases::EventKind::stylet_out}};
  constexpr std::uint64_t kStands = 1950, kOut = 4000, kInAgain = 6000;
  for (const double aside_mm : {0.0, 15.0}) {
    cases::Case scene = ball(cases::Modality::xray, Tissue::still);
    scene.instrument.kind = cases::InstrumentKind::core;
    const Tick tick(scene);
    TickState now;
    std::optional<StandingTube> stands;
    for (std::uint64_t i = 0; i < kInAgain; ++i) {
      cases::Inputs inputs = hands_at(i);
      inputs.fire = false;
      inputs.needle.position_lps_mm.x = i < kOut ? 0.0 : aside_mm;
      inputs.needle.axis = {0.0, 1.0, 0.0};
      Scenario(said).add_to(inputs, now.state.t_s, now.happened);
      tick.advance_hands(inputs, {}, now);
      if (i == kStands) {
        stands = moment_of(now).tube;
        ASSERT_TRUE(stands.has_value());
        const double in_mm = glm::distance(stands->end_lps_mm, stands->entry_lps_mm);
        EXPECT_GT(in_mm, 5.0);
        EXPECT_NEAR(in_mm, now.hands[1].needle.track.sheath_mm, 1e-9);
      }
      if (i == kOut) {
        ASSERT_FALSE(now.state.needle.skin.in_body);
        ASSERT_EQ(now.introducer, haptics::Introducer::open);
        const auto left = moment_of(now).tube;
        ASSERT_TRUE(left.has_value()) << "it stays when the needle is out";
        EXPECT_EQ(left->end_lps_mm, stands->end_lps_mm);
        EXPECT_EQ(left->entry_lps_mm, stands->entry_lps_mm);
      }
    }
    EXPECT_EQ(moment_of(now).tube.has_value(), aside_mm == 0.0);
    ASSERT_TRUE(now.state.needle.skin.in_body);
    EXPECT_EQ(now.introducer, aside_mm > 0.0 ? haptics::Introducer::none : haptics::Introducer::open) << aside_mm;
  }
}

// A recording's hash is of State alone, chained, whatever else there is to be saved.
TEST(Tick, KeepsTheChainedHashOfTheStep) {
  const cases::Case scene = ball(cases::Modality::mpr, Tissue::still);
  const Tick tick(scene);
  TickState now;
  cases::State state;
  std::uint64_t hash = 0;
  for (int i = 0; i < 3000; ++i) {
    const cases::RecordedTick made = turn(tick, now);
    step(scene, made.inputs, base::kTickS, state);
    hash = cases::state_hash(state, hash);
    ASSERT_EQ(made.hash, static_cast<std::uint32_t>(hash)) << i;
  }
  EXPECT_EQ(now.hash, hash);
}

TEST(Tick, IsSharedByAttemptsAndMakesNoAllocation) {
  const cases::Case scene = ball(cases::Modality::ultrasound, Tissue::moving);
  const Tick tick(scene);
  TickState one, other;
  for (int i = 0; i < 500; ++i) turn(tick, one);
  const long before = fixtures::allocations();
  for (int i = 0; i < 500; ++i) {
    turn(tick, other);
    turn(tick, one);
  }
  EXPECT_EQ(fixtures::allocations(), before);
  EXPECT_EQ(tick_state_hash(other), tick_state_hash(after(tick, 500)));
  EXPECT_EQ(tick_state_hash(one), tick_state_hash(after(tick, 1000)));
}

TEST(Scenario, HappensOnceAndWhereNobodyElseSpeaks) {
  const Scenario scenario(kScenario);
  std::uint32_t happened = 0;
  cases::Inputs inputs;
  scenario.add_to(inputs, 0.499, happened);
  EXPECT_EQ(inputs.event, cases::EventKind::none);
  inputs.event = cases::EventKind::aspirate;
  scenario.add_to(inputs, 0.5, happened);
  EXPECT_EQ(inputs.event, cases::EventKind::aspirate);
  EXPECT_EQ(happened, 0U);
  inputs.event = cases::EventKind::none;
  scenario.add_to(inputs, 0.501, happened);
  EXPECT_EQ(inputs.event, cases::EventKind::cough);
  EXPECT_EQ(happened, 1U);
  inputs.event = cases::EventKind::none;
  scenario.add_to(inputs, 0.502, happened);
  EXPECT_EQ(inputs.event, cases::EventKind::none);
  happened = 2;
  scenario.add_to(inputs, 100.0, happened);
  EXPECT_EQ(inputs.event, cases::EventKind::none) << "all of it has happened";
}

}  // namespace
}  // namespace seldinger::engine
