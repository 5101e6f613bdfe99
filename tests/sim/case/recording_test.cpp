// Tests of sim/case/recording and sim/case/state.
#include "sim/case/recording.h"

#include <gtest/gtest.h>

#include "sim/base/rng.h"
#include "sim/case/state.h"

namespace seldinger::cases {
namespace {

glm::dvec3 random_vector(base::Rng& rng) {
  return {rng.normal(), rng.normal(), rng.normal()};
}

Recording random_recording(std::size_t ticks, std::uint64_t seed) {
  base::Rng rng(seed);
  Recording recording;
  recording.step_version = 7;
  recording.dt_s = 0.001;
  for (std::size_t i = 0; i < ticks; ++i) {
    Inputs inputs;
    for (ToolPose* pose : {&inputs.needle, &inputs.probe})
      *pose = {random_vector(rng) * 100.0, random_vector(rng), random_vector(rng)};
    inputs.fire = i + 5 > ticks;
    inputs.freeze = i % 3 == 0;
    recording.inputs.push_back(inputs);
    recording.hashes.push_back(static_cast<std::uint32_t>(rng.bits()));
    const double t_s = static_cast<double>(i + 1) * 0.001;
    if (i % 10 == 0)
      recording.poses.push_back({t_s, random_vector(rng), random_vector(rng), random_vector(rng),
                                 random_vector(rng), random_vector(rng)});
    if (i % 33 == 0) recording.frames.push_back({t_s, i % 2 == 0, i % 5 == 0, i % 7 == 0, rng.uniform() * 100.0});
  }
  if (ticks > 0)
    recording.endpoint = Endpoint{static_cast<double>(ticks / 2) * 0.001, random_vector(rng), {0, 0, 1}};
  return recording;
}

void expect_same(const Recording& a, const Recording& b) {
  EXPECT_EQ(a.step_version, b.step_version);
  EXPECT_EQ(a.dt_s, b.dt_s);
  ASSERT_EQ(a.inputs.size(), b.inputs.size());
  for (std::size_t i = 0; i < a.inputs.size(); ++i) {
    EXPECT_EQ(a.inputs[i].needle.position_lps_mm, b.inputs[i].needle.position_lps_mm);
    EXPECT_EQ(a.inputs[i].needle.axis, b.inputs[i].needle.axis);
    EXPECT_EQ(a.inputs[i].needle.side, b.inputs[i].needle.side);
    EXPECT_EQ(a.inputs[i].probe.position_lps_mm, b.inputs[i].probe.position_lps_mm);
    EXPECT_EQ(a.inputs[i].probe.axis, b.inputs[i].probe.axis);
    EXPECT_EQ(a.inputs[i].probe.side, b.inputs[i].probe.side);
    EXPECT_EQ(a.inputs[i].fire, b.inputs[i].fire);
    EXPECT_EQ(a.inputs[i].freeze, b.inputs[i].freeze);
  }
  EXPECT_EQ(a.hashes, b.hashes);
  EXPECT_EQ(a.poses, b.poses);
  EXPECT_EQ(a.endpoint, b.endpoint);
  ASSERT_EQ(a.frames.size(), b.frames.size());
  for (std::size_t i = 0; i < a.frames.size(); ++i) {
    EXPECT_EQ(a.frames[i].t_s, b.frames[i].t_s);
    EXPECT_EQ(a.frames[i].live, b.frames[i].live);
    EXPECT_EQ(a.frames[i].needle_tip, b.frames[i].needle_tip);
    EXPECT_EQ(a.frames[i].target, b.frames[i].target);
    EXPECT_EQ(a.frames[i].needle_length_mm, b.frames[i].needle_length_mm);
  }
}

TEST(Recording, ComesBackBitForBit) {
  for (const std::size_t ticks : {std::size_t{0}, std::size_t{1}, std::size_t{1999}, std::size_t{2000},
                                  std::size_t{2001}, std::size_t{6500}}) {
    const Recording recording = random_recording(ticks, ticks);
    const auto chunks = chunks_from_recording(recording);
    const auto back = recording_from_chunks(chunks);
    ASSERT_TRUE(back.has_value()) << ticks;
    expect_same(recording, *back);
  }
}

TEST(Recording, EveryDamagedChunkIsRefused) {
  const auto chunks = chunks_from_recording(random_recording(4500, 9));
  ASSERT_EQ(chunks.size(), 3U);
  for (std::size_t c = 0; c < chunks.size(); ++c)
    for (std::size_t i = 0; i < chunks[c].data.size(); i += chunks[c].data.size() / 50 + 1) {
      auto damaged = chunks;
      damaged[c].data[i] ^= std::byte{1};
      const auto read = recording_from_chunks(damaged);
      ASSERT_FALSE(read.has_value());
      EXPECT_EQ(read.error().code, "damaged");
    }
}

TEST(Recording, AMissingOrForeignChunkIsRefused) {
  auto chunks = chunks_from_recording(random_recording(6500, 10));
  auto missing = chunks;
  missing.erase(missing.begin() + 1);
  EXPECT_EQ(recording_from_chunks(missing).error().code, "incomplete");
  EXPECT_EQ(recording_from_chunks({}).error().code, "incomplete");
  Recording other = random_recording(6500, 11);
  other.step_version = 8;
  auto mixed = chunks;
  mixed[1] = chunks_from_recording(other)[1];
  EXPECT_EQ(recording_from_chunks(mixed).error().code, "damaged");
}

TEST(Recording, SlowMotionIsSmall) {
  Recording recording;
  recording.step_version = 1;
  for (int i = 0; i < 20'000; ++i) {
    Inputs inputs;
    inputs.needle.position_lps_mm = {std::floor(i * 0.032) / 32.0, 10.0, -5.0};
    recording.inputs.push_back(inputs);
    recording.hashes.push_back(0);
  }
  std::size_t bytes = 0;
  for (const auto& chunk : chunks_from_recording(recording)) bytes += chunk.data.size();
  EXPECT_LT(bytes, 20'000U) << "under one byte a tick";
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
  EXPECT_TRUE(changes([](State& s) { s.fire.fired = true; }));
  EXPECT_TRUE(changes([](State& s) { s.fire.t_s = 1; }));
  EXPECT_TRUE(changes([](State& s) { s.fire.tip_lps_mm.x = 1; }));
  EXPECT_TRUE(changes([](State& s) { s.fire.direction.x = 1; }));
}

}  // namespace
}  // namespace seldinger::cases
