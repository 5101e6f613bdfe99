// Tests of assessment/recorder: what goes in comes out, whoever is slow, and the servo never waits.
#include "assessment/recorder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "sim/base/rng.h"
#include "tests/fixtures/allocations.h"
#include "tests/fixtures/until.h"

namespace seldinger::assessment {
namespace {

cases::RecordedTick tick_of(std::uint64_t at) {
  cases::RecordedTick tick;
  tick.inputs.needle.position_lps_mm = {base::uniform_at(1, at), static_cast<double>(at), 3.0};
  tick.hash = static_cast<std::uint32_t>(at * 2654435761U);
  const double t_s = static_cast<double>(at + 1) * 0.001;
  if (at % 10 == 0) {
    tick.pose = cases::PoseSample{};
    tick.pose->t_s = t_s;
    tick.force = cases::ForceSample{t_s, 1.0, 2.0, 3.0};
  }
  if (at % 1500 == 700) tick.inputs.event = cases::EventKind::nick;
  if (at % 3000 == 700) tick.reaction = cases::EventKind::pain_bone;
  if (at == 4321) tick.endpoint = cases::Endpoint{t_s, {1, 2, 3}, {0, 0, 1}};
  return tick;
}

cases::FrameTruth frame_at(double t_s) {
  cases::FrameTruth frame;
  frame.t_s = t_s;
  frame.needle_length_mm = t_s;
  return frame;
}

TEST(Recorder, WhatGoesInComesOut) {
  std::vector<cases::RecordingChunk> chunks;
  Recorder recorder(5, 0.001, [&](const cases::RecordingChunk& chunk) {
    chunks.push_back(chunk);
    return base::Result<void>{};
  });
  constexpr std::uint64_t kTicks = 6100;
  for (std::uint64_t at = 0; at < kTicks; ++at) {
    ASSERT_TRUE(recorder.tick(tick_of(at)));
    if (at % 33 == 0) recorder.frame(frame_at(static_cast<double>(at + 1) * 0.001));
  }
  EXPECT_EQ(recorder.finish().value(), 4U);
  EXPECT_EQ(recorder.finish().value(), 4U) << "again: the same";
  EXPECT_FALSE(recorder.failed());
  const auto recording = cases::recording_from_chunks(chunks);
  ASSERT_TRUE(recording.has_value()) << recording.error().text;
  EXPECT_EQ(recording->step_version, 5U);
  ASSERT_EQ(recording->inputs.size(), kTicks);
  ASSERT_EQ(recording->poses.size(), kTicks / 10);
  ASSERT_EQ(recording->forces.size(), kTicks / 10);
  ASSERT_EQ(recording->frames.size(), (kTicks + 32) / 33);
  for (std::uint64_t at = 0; at < kTicks; ++at) {
    EXPECT_EQ(recording->inputs[at].needle.position_lps_mm, tick_of(at).inputs.needle.position_lps_mm);
    EXPECT_EQ(recording->hashes[at], tick_of(at).hash);
  }
  for (std::size_t i = 1; i < recording->frames.size(); ++i)
    EXPECT_GT(recording->frames[i].t_s, recording->frames[i - 1].t_s);
  std::vector<cases::Event> events;
  for (std::uint64_t at = 0; at < kTicks; ++at)
    cases::add_events(static_cast<double>(at + 1) * 0.001, tick_of(at), events);
  EXPECT_EQ(events.size(), 4U + 2U);
  EXPECT_EQ(recording->events, events);
  EXPECT_EQ(recording->endpoint, tick_of(4321).endpoint);
}

TEST(Recorder, AnAttemptOfNoTicksIsARecordingToo) {
  std::vector<cases::RecordingChunk> chunks;
  Recorder recorder(1, 0.001, [&](const cases::RecordingChunk& chunk) {
    chunks.push_back(chunk);
    return base::Result<void>{};
  });
  EXPECT_EQ(recorder.finish().value(), 1U);
  EXPECT_TRUE(cases::recording_from_chunks(chunks)->inputs.empty());
}

// Beside the inputs: in the tick in which it was, or once no tick comes any more.
TEST(Recorder, WhatIsNotedIsAnEventAndNoInput) {
  std::vector<cases::RecordingChunk> chunks;
  Recorder recorder(5, 0.001, [&](const cases::RecordingChunk& chunk) {
    chunks.push_back(chunk);
    return base::Result<void>{};
  });
  for (std::uint64_t at = 0; at < 2000; ++at) {
    cases::RecordedTick tick = tick_of(at);
    if (at == 700) tick.noted = cases::EventKind::guide_on;
    if (at == 900) tick.noted = cases::EventKind::paused;
    if (at == 900) tick.noted_wall_s = 41.5;
    ASSERT_TRUE(recorder.tick(tick));
  }
  recorder.note({2.0, cases::EventKind::paused, 7.0});
  ASSERT_TRUE(recorder.finish());
  const auto recording = cases::recording_from_chunks(chunks);
  ASSERT_TRUE(recording.has_value()) << recording.error().text;
  const std::vector<cases::Event> expected = {{701 * 0.001, cases::EventKind::nick},
                                              {701 * 0.001, cases::EventKind::pain_bone},
                                              {701 * 0.001, cases::EventKind::guide_on},
                                              {901 * 0.001, cases::EventKind::paused, 41.5},
                                              {2.0, cases::EventKind::paused, 7.0}};
  EXPECT_EQ(recording->events, expected);
  EXPECT_EQ(recording->inputs[900].event, cases::EventKind::none);
}

// A disk that hangs: the servo goes on, and what was recorded is whole up to where the queue was full.
TEST(Recorder, AServoNeverWaitsForTheDisk) {
  std::vector<cases::RecordingChunk> chunks;
  std::atomic<bool> hang{true};
  Recorder recorder(1, 0.001, [&](const cases::RecordingChunk& chunk) {
    EXPECT_TRUE(fixtures::until([&] { return !hang; }));
    chunks.push_back(chunk);
    return base::Result<void>{};
  });
  std::uint64_t taken = 0;
  std::vector<cases::RecordedTick> ticks;
  for (std::uint64_t at = 0; at < 12000; ++at) ticks.push_back(tick_of(at));
  const long before = fixtures::allocations_of_this_thread();
  for (const cases::RecordedTick& tick : ticks) taken += recorder.tick(tick) ? 1 : 0;
  EXPECT_EQ(fixtures::allocations_of_this_thread(), before);
  EXPECT_TRUE(recorder.fell_behind());
  EXPECT_LT(taken, ticks.size());
  EXPECT_GE(taken, Recorder::kQueueTicks);
  EXPECT_FALSE(recorder.tick(ticks[0])) << "from then on";
  hang = false;
  ASSERT_TRUE(recorder.finish().has_value());
  EXPECT_EQ(cases::recording_from_chunks(chunks)->inputs.size(), taken);
}

TEST(Recorder, TheFirstErrorOfTheDiskIsKept) {
  int asked = 0;
  Recorder recorder(1, 0.001, [&](const cases::RecordingChunk&) -> base::Result<void> {
    return ++asked > 1 ? base::Result<void>(base::Error{"disk", "full " + std::to_string(asked)})
                       : base::Result<void>{};
  });
  for (std::uint64_t at = 0; at < 8000; ++at) recorder.tick(tick_of(at));
  EXPECT_EQ(recorder.finish().error().text, "full 2");
  EXPECT_EQ(asked, 2) << "nothing is stored behind a hole";
  EXPECT_TRUE(recorder.failed());
  EXPECT_FALSE(recorder.fell_behind());
}

// One recorder stored two whole chunks and was gone; another goes on where they end.
TEST(Recorder, GoesOnWhereAnotherEnded) {
  std::vector<cases::RecordingChunk> whole, pieces;
  const auto record = [](std::vector<cases::RecordingChunk>& chunks, std::uint64_t from, std::uint64_t to,
                         RecordedBefore before) {
    Recorder recorder(
        5, 0.001,
        [&](const cases::RecordingChunk& chunk) {
          chunks.push_back(chunk);
          return base::Result<void>{};
        },
        before);
    for (std::uint64_t at = from; at < to; ++at) {
      EXPECT_TRUE(recorder.tick(tick_of(at)));
      if (at % 33 == 0) recorder.frame(frame_at(static_cast<double>(at + 1) * 0.001));
    }
    return recorder.finish().value();
  };
  EXPECT_EQ(record(whole, 0, 6100, {}), 4U);
  EXPECT_EQ(record(pieces, 0, 4000, {}), 2U);
  EXPECT_EQ(record(pieces, 4000, 6100, {4000, 2}), 4U);
  ASSERT_EQ(pieces.size(), whole.size());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_EQ(pieces[i].sequence, i);
    EXPECT_EQ(pieces[i].checksum, whole[i].checksum) << "bit for bit, chunk " << i;
  }
  EXPECT_EQ(record(pieces, 0, 0, {6100, 4}), 4U) << "nothing came: no empty chunk";
}

}  // namespace
}  // namespace seldinger::assessment
