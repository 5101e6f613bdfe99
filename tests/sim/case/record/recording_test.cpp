#include "sim/case/record/recording.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <functional>

#include "sim/base/codec.h"
#include "sim/base/hash.h"
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
    if (i % 10 == 0 && seed % 2 == 0) recording.forces.push_back({t_s, rng.normal(), rng.uniform(), rng.uniform()});
    if (seed % 2 == 0) {
      if (i == 0) recording.events.emplace();
      if (i % 701 == 3) {
        const EventKind kind = event_kinds()[i % event_kinds().size()].kind;
        const auto tenths_mm = static_cast<std::uint16_t>(i % 3 == 0 ? 0 : 977 * i);
        recording.inputs.back().event = kind;
        recording.inputs.back().event_tenths_mm = tenths_mm;
        recording.events->push_back({t_s, kind, 0.0, tenths_mm});
      }
    }
    if (i % 33 == 0) recording.frames.push_back({t_s, i % 2 == 0, i % 5 == 0, i % 7 == 0, rng.uniform() * 100.0});
  }
  if (ticks > 0)
    recording.endpoint = Endpoint{static_cast<double>(ticks / 2) * 0.001, random_vector(rng), {0, 0, 1}};
  return recording;
}

// As random_recording, of an attempt guided by fluoroscopy; `from` is the first tick in which it is used.
Recording random_xray_recording(std::size_t ticks, std::uint64_t seed, std::size_t from = 0) {
  Recording recording = random_recording(ticks, seed);
  base::Rng rng(seed + 1);
  for (std::size_t i = from; i < ticks; ++i) {
    Inputs& inputs = recording.inputs[i];
    FluoroscopeInputs& asked = inputs.fluoroscope;
    asked = {i % 2 == 0,
             rng.normal(),
             rng.normal(),
             rng.normal(),
             random_vector(rng),
             {rng.uniform(), rng.uniform()},
             i % 5 == 0 ? -3 : static_cast<int>(i % 3),
             static_cast<int>(i % 4) - 1,
             i % 7 != 0,
             rng.normal(),
             rng.normal(),
             i % 11 == 0};
    inputs.exposure = {static_cast<std::uint32_t>(rng.bits()),
                       rng.normal(),
                       rng.normal(),
                       {rng.normal(), rng.normal(), rng.normal()},
                       i % 13 == 0};
  }
  for (std::size_t i = 0; i < recording.frames.size(); ++i)
    if (i % 4 != 3 && recording.frames[i].t_s >= static_cast<double>(from) * 0.001)
      recording.frames[i].beam = BeamTruth{rng.normal(), rng.normal(),  rng.normal(),  rng.normal(), rng.normal(),
                                           rng.normal(), rng.uniform(), rng.uniform(), i % 3 == 0,   i % 5 == 0};
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
    EXPECT_EQ(a.inputs[i].event, b.inputs[i].event);
    EXPECT_EQ(a.inputs[i].event_tenths_mm, b.inputs[i].event_tenths_mm);
    EXPECT_EQ(a.inputs[i].console, b.inputs[i].console);
    EXPECT_EQ(a.inputs[i].fluoroscope, b.inputs[i].fluoroscope);
    EXPECT_EQ(a.inputs[i].exposure, b.inputs[i].exposure);
  }
  EXPECT_EQ(a.hashes, b.hashes);
  EXPECT_EQ(a.poses, b.poses);
  EXPECT_EQ(a.forces, b.forces);
  EXPECT_EQ(a.events, b.events);
  EXPECT_EQ(a.endpoint, b.endpoint);
  ASSERT_EQ(a.frames.size(), b.frames.size());
  for (std::size_t i = 0; i < a.frames.size(); ++i) {
    EXPECT_EQ(a.frames[i].t_s, b.frames[i].t_s);
    EXPECT_EQ(a.frames[i].live, b.frames[i].live);
    EXPECT_EQ(a.frames[i].needle_tip, b.frames[i].needle_tip);
    EXPECT_EQ(a.frames[i].target, b.frames[i].target);
    EXPECT_EQ(a.frames[i].needle_length_mm, b.frames[i].needle_length_mm);
    EXPECT_EQ(a.frames[i].beam, b.frames[i].beam);
    EXPECT_EQ(a.frames[i].near_plane, b.frames[i].near_plane);
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

// As it is recorded: a piece after the other, each of what came while it was open.
TEST(Recording, InPiecesItIsTheSameRecording) {
  const Recording whole = random_recording(5100, 8);
  ASSERT_FALSE(whole.forces.empty());
  ASSERT_EQ(whole.events->size(), 8U);
  std::vector<RecordingChunk> chunks;
  for (std::size_t begin = 0; begin < whole.inputs.size(); begin += 700) {
    const std::size_t end = std::min(begin + 700, whole.inputs.size());
    Recording piece;
    piece.step_version = whole.step_version;
    piece.dt_s = whole.dt_s;
    const auto range = [](const auto& rows, auto& into, const auto& keep) {
      for (const auto& row : rows)
        if (keep(row)) into.push_back(row);
    };
    for (std::size_t i = begin; i < end; ++i) {
      piece.inputs.push_back(whole.inputs[i]);
      piece.hashes.push_back(whole.hashes[i]);
    }
    const auto now = [&](const auto& row) {
      const double tick = row.t_s / whole.dt_s - 0.5;
      return tick >= static_cast<double>(begin) && tick < static_cast<double>(end);
    };
    range(whole.poses, piece.poses, now);
    range(whole.forces, piece.forces, now);
    range(whole.frames, piece.frames, now);
    range(*whole.events, piece.events.emplace(), now);
    if (now(*whole.endpoint)) piece.endpoint = whole.endpoint;
    chunks.push_back(chunk_of(piece, static_cast<std::uint32_t>(chunks.size())));
  }
  EXPECT_EQ(chunks.size(), 8U);
  const auto back = recording_from_chunks(chunks);
  ASSERT_TRUE(back.has_value());
  expect_same(whole, *back);
}

TEST(Recording, OfAFluoroscopeComesBackBitForBit) {
  // In the last chunk only; in all; and its use begins in the middle of one.
  for (const std::size_t from : {std::size_t{0}, std::size_t{3000}, std::size_t{6001}}) {
    const Recording recording = random_xray_recording(6500, 20 + from, from);
    const auto back = recording_from_chunks(chunks_from_recording(recording));
    ASSERT_TRUE(back.has_value()) << from;
    expect_same(recording, *back);
  }
}

// Every fourth frame says nothing of the plane; the others every combination.
Recording random_ultrasound_recording(std::size_t ticks, std::uint64_t seed) {
  Recording recording = random_recording(ticks, seed);
  for (std::size_t i = 0; i < recording.frames.size(); ++i)
    if (i % 4 != 0)
      recording.frames[i].near_plane = NearPlane{(i & 1U) != 0, (i & 2U) != 0, (i & 4U) != 0, (i & 8U) != 0};
  return recording;
}

TEST(Recording, WhatWasNearThePlaneComesBack) {
  const Recording recording = random_ultrasound_recording(6500, 31);
  ASSERT_GT(recording.frames.size(), 64U);
  const auto back = recording_from_chunks(chunks_from_recording(recording));
  ASSERT_TRUE(back.has_value());
  expect_same(recording, *back);
}

// As random_recording, its console turned from the tick `from` on.
Recording random_console_recording(std::size_t ticks, std::uint64_t seed, std::size_t from = 0) {
  Recording recording = random_recording(ticks, seed);
  base::Rng rng(seed + 2);
  ConsoleSetting console;
  for (std::size_t i = from; i < ticks; ++i) {
    if ((i - from) % 300 == 0) console = {rng.uniform() * 200.0, rng.uniform(), rng.normal(), rng.normal()};
    recording.inputs[i].console = console;
  }
  return recording;
}

std::size_t bytes_of(const Recording& recording) {
  std::size_t bytes = 0;
  for (const auto& chunk : chunks_from_recording(recording))
    bytes += base::decompress(chunk.data, 1U << 24)->size();
  return bytes;
}

TEST(Recording, OfAConsoleThatIsTurnedComesBackBitForBit) {
  // In all chunks; from the middle of one; in the last alone; and beside a fluoroscope, which no attempt has.
  for (const std::size_t from : {std::size_t{0}, std::size_t{3000}, std::size_t{6001}}) {
    const Recording recording = random_console_recording(6500, 40 + from, from);
    const auto back = recording_from_chunks(chunks_from_recording(recording));
    ASSERT_TRUE(back.has_value()) << back.error().text;
    expect_same(recording, *back);
  }
  Recording both = random_xray_recording(2500, 41, 900);
  for (std::size_t i = 2100; i < 2500; ++i) both.inputs[i].console.slice_mm = 0.01 * static_cast<double>(i);
  const auto back = recording_from_chunks(chunks_from_recording(both));
  ASSERT_TRUE(back.has_value()) << back.error().text;
  expect_same(both, *back);
}

TEST(Recording, AConsoleThatIsNotTurnedTakesNoRoom) {
  const std::size_t without = bytes_of(random_recording(4000, 5));
  EXPECT_EQ(bytes_of(random_console_recording(4000, 5, 3000)), without + 8 * 2000 * 4) << "in the second chunk";
}

TEST(Recording, HowLongAPauseWasComesBackAndOtherEventsTakeNoRoomForIt) {
  Recording recording = random_recording(6500, 8);
  const std::size_t without = bytes_of(recording);
  const std::size_t events = recording.events->size();
  const auto second = std::find_if(recording.events->begin(), recording.events->end(),
                                   [](const Event& event) { return event.t_s >= 2.0; });
  const Event pause{2.5, EventKind::paused, 12.25};
  const auto place =
      std::find_if(second, recording.events->end(), [&](const Event& event) { return event.t_s > 2.5; });
  recording.events->insert(place, pause);
  const auto in_second = std::count_if(recording.events->begin(), recording.events->end(),
                                       [](const Event& event) { return event.t_s >= 2.0 && event.t_s < 4.0; });
  EXPECT_EQ(bytes_of(recording), without + 8 * (2 + static_cast<std::size_t>(in_second))) << "in its chunk alone";
  const auto back = recording_from_chunks(chunks_from_recording(recording));
  ASSERT_TRUE(back.has_value()) << back.error().text;
  expect_same(recording, *back);
  EXPECT_EQ(back->events->size(), events + 1);
  for (Event& event : *recording.events)
    if (event.kind == EventKind::paused) event.wall_s = -1.0;
  EXPECT_EQ(recording_from_chunks(chunks_from_recording(recording)).error().code, "damaged");
}

TEST(Recording, AFluoroscopeThatIsNotUsedTakesNoRoom) {
  // The columns of format 1: 20, 16 and 3 words a row; 104 bytes of head.
  const Recording recording = random_recording(2000, 3);
  EXPECT_TRUE(recording.forces.empty());
  EXPECT_EQ(bytes_of(recording), 104 + 8 * (2000 * 20 + 200 * 16 + recording.frames.size() * 3));
}

// The layout that format 1 had, by its description: head, then three tables, column by column, byte plane by byte
// plane, each row as XOR with the one before.
std::vector<std::byte> table_of_format_1(const std::vector<std::vector<std::uint64_t>>& rows) {
  std::vector<std::byte> out;
  for (std::size_t column = 0; !rows.empty() && column < rows[0].size(); ++column)
    for (unsigned plane = 0; plane < 64; plane += 8)
      for (std::size_t row = 0; row < rows.size(); ++row) {
        const std::uint64_t before = row > 0 ? rows[row - 1][column] : 0;
        out.push_back(static_cast<std::byte>((rows[row][column] ^ before) >> plane));
      }
  return out;
}

RecordingChunk chunk_of_format_1(const Recording& recording, std::uint32_t format = 1, std::uint32_t reserved = 0,
                                 std::uint64_t more_bits = 0) {
  const auto word = [](double value) { return std::bit_cast<std::uint64_t>(value); };
  const auto add = [&](std::vector<std::uint64_t>& row, const glm::dvec3& p) {
    for (int axis = 0; axis < 3; ++axis) row.push_back(word(p[axis]));
  };
  std::vector<std::vector<std::uint64_t>> inputs, poses, frames;
  for (std::size_t i = 0; i < recording.inputs.size(); ++i) {
    const Inputs& in = recording.inputs[i];
    std::vector<std::uint64_t>& row = inputs.emplace_back();
    for (const ToolPose& pose : {in.needle, in.probe})
      for (const glm::dvec3& p : {pose.position_lps_mm, pose.axis, pose.side}) add(row, p);
    row.push_back((in.fire ? 1U : 0U) + (in.freeze ? 2U : 0U));
    row.push_back(recording.hashes[i]);
  }
  for (const PoseSample& pose : recording.poses) {
    std::vector<std::uint64_t>& row = poses.emplace_back();
    row.push_back(word(pose.t_s));
    for (const glm::dvec3& p :
         {pose.tip_lps_mm, pose.needle_direction, pose.probe_origin_lps_mm, pose.probe_axial, pose.probe_lateral})
      add(row, p);
  }
  for (const FrameTruth& frame : recording.frames)
    frames.push_back(
        {word(frame.t_s), word(frame.needle_length_mm),
         (frame.live ? 1U : 0U) + (frame.needle_tip ? 2U : 0U) + (frame.target ? 4U : 0U) + more_bits});
  const std::uint32_t head[8] = {0x524c4453,
                                 format,
                                 recording.step_version,
                                 static_cast<std::uint32_t>(inputs.size()),
                                 static_cast<std::uint32_t>(poses.size()),
                                 static_cast<std::uint32_t>(frames.size()),
                                 1,
                                 reserved};
  const Endpoint& end = *recording.endpoint;
  const double rest[8] = {recording.dt_s,   end.t_s,         end.tip_lps_mm.x, end.tip_lps_mm.y,
                          end.tip_lps_mm.z, end.direction.x, end.direction.y,  end.direction.z};
  std::vector<std::byte> raw(sizeof head + sizeof rest);
  std::memcpy(raw.data(), head, sizeof head);
  std::memcpy(raw.data() + sizeof head, rest, sizeof rest);
  for (const auto& table : {inputs, poses, frames}) {
    const auto bytes = table_of_format_1(table);
    raw.insert(raw.end(), bytes.begin(), bytes.end());
  }
  RecordingChunk chunk;
  chunk.data = base::compress(raw);
  chunk.checksum = base::hash_bytes(chunk.data);
  return chunk;
}

TEST(Recording, OfFormat1IsRead) {
  const Recording recording = random_recording(1500, 15);
  const auto back = recording_from_chunks(std::vector{chunk_of_format_1(recording)});
  ASSERT_TRUE(back.has_value()) << back.error().text;
  expect_same(recording, *back);
  for (const Inputs& inputs : back->inputs) ASSERT_EQ(inputs.fluoroscope, FluoroscopeInputs{});
}

TEST(Recording, OfFormat2SaysNothingOfThePlane) {
  const Recording recording = random_recording(1500, 17);
  // The bits that format 3 gave a meaning.
  const auto old = recording_from_chunks(std::vector{chunk_of_format_1(recording, 2, 0, 64 + 128 + 1024)});
  ASSERT_TRUE(old.has_value());
  expect_same(recording, *old);
  const auto now = recording_from_chunks(std::vector{chunk_of_format_1(recording, 3, 0, 64 + 128 + 1024)});
  ASSERT_TRUE(now.has_value());
  EXPECT_EQ(now->frames[0].near_plane, (NearPlane{true, false, false, true}));
}

// A chunk's bytes, changed, as a chunk of its own.
RecordingChunk with_bytes(const RecordingChunk& chunk, const std::function<void(std::vector<std::byte>&)>& change) {
  auto raw = *base::decompress(chunk.data, 1U << 24);
  change(raw);
  RecordingChunk made{chunk.sequence, 0, base::compress(raw)};
  made.checksum = base::hash_bytes(made.data);
  return made;
}

TEST(Recording, OfFormat4SaysNothingOfEvents) {
  Recording recording = random_recording(1500, 18);
  recording.events->clear();
  const auto as_format_4 = with_bytes(chunks_from_recording(recording)[0], [](std::vector<std::byte>& raw) {
    raw[4] = std::byte{4};
    std::memset(raw.data() + 100, 0, 4);  // the word that was not used
  });
  for (Inputs& inputs : recording.inputs) {  // their bits had no meaning
    inputs.event = EventKind::none;
    inputs.event_tenths_mm = 0;
  }
  recording.events.reset();
  const auto back = recording_from_chunks(std::vector{as_format_4});
  ASSERT_TRUE(back.has_value()) << back.error().text;
  expect_same(recording, *back);
}

TEST(Recording, OfFormat5IsReadAndHasNoConsole) {
  const auto as_format_5 = [](const Recording& recording) {
    return std::vector{with_bytes(chunks_from_recording(recording)[0],
                                  [](std::vector<std::byte>& raw) { raw[4] = std::byte{5}; })};
  };
  Recording recording = random_recording(1500, 18);
  recording.endpoint->rest_tip_lps_mm = glm::dvec3(1, 2, 3);
  for (PoseSample& pose : recording.poses) pose.rest_tip_lps_mm = pose.tip_lps_mm;
  const auto back = recording_from_chunks(as_format_5(recording));
  ASSERT_TRUE(back.has_value()) << back.error().text;
  expect_same(recording, *back);
  const auto impossible = recording_from_chunks(as_format_5(random_console_recording(1500, 18)));
  ASSERT_FALSE(impossible.has_value()) << "format 5 had no console";
  EXPECT_EQ(impossible.error().code, "damaged");
}

TEST(Recording, FlowInColourComesBackAndTakesRoomWhereItWasShown) {
  Recording recording = random_console_recording(4000, 5);
  const std::size_t without = bytes_of(recording);
  for (std::size_t i = 2500; i < 4000; ++i) recording.inputs[i].console.colour_mm_s = i < 3000 ? 200.0 : 120.5;
  EXPECT_EQ(bytes_of(recording), without + 8 * 2000) << "in the second chunk";
  const auto back = recording_from_chunks(chunks_from_recording(recording));
  ASSERT_TRUE(back.has_value()) << back.error().text;
  expect_same(recording, *back);
  auto chunks = chunks_from_recording(recording);
  for (RecordingChunk& chunk : chunks)
    chunk = with_bytes(chunk, [](std::vector<std::byte>& raw) { raw[4] = std::byte{7}; });
  EXPECT_EQ(recording_from_chunks(chunks).error().code, "damaged") << "format 7 had no colour";
}

TEST(Recording, WhichWayTheConsoleLookedComesBackAndTakesRoomWhereItDidAside) {
  for (double ConsoleSetting::*const number : {&ConsoleSetting::compound_deg, &ConsoleSetting::lean_deg,
                                               &ConsoleSetting::box_across, &ConsoleSetting::box_down}) {
    Recording recording = random_console_recording(4000, 5);
    const std::size_t without = bytes_of(recording);
    for (std::size_t i = 2500; i < 4000; ++i) recording.inputs[i].console.*number = i < 3000 ? 12.0 : 0.25;
    EXPECT_EQ(bytes_of(recording), without + 8 * 2000 * 4) << "in the second chunk";
    const auto back = recording_from_chunks(chunks_from_recording(recording));
    ASSERT_TRUE(back.has_value()) << back.error().text;
    expect_same(recording, *back);
    auto chunks = chunks_from_recording(recording);
    for (RecordingChunk& chunk : chunks)
      chunk = with_bytes(chunk, [](std::vector<std::byte>& raw) { raw[4] = std::byte{8}; });
    EXPECT_EQ(recording_from_chunks(chunks).error().code, "damaged") << "format 8 looked straight ahead";
  }
}

TEST(Recording, OfFormat7IsRead) {
  const Recording recording = random_console_recording(1500, 18);
  auto chunks = chunks_from_recording(recording);
  for (RecordingChunk& chunk : chunks)
    chunk = with_bytes(chunk, [](std::vector<std::byte>& raw) { raw[4] = std::byte{7}; });
  const auto back = recording_from_chunks(chunks);
  ASSERT_TRUE(back.has_value()) << back.error().text;
  expect_same(recording, *back);
}

TEST(Recording, OfAPatientWhoMovesComesBackBitForBit) {
  for (const bool from_the_start : {true, false}) {
    Recording recording = random_recording(6500, 18);
    base::Rng rng(4);
    for (PoseSample& pose : recording.poses)
      if (from_the_start || pose.t_s > 3.0) pose.rest_tip_lps_mm = random_vector(rng);
    recording.endpoint->rest_tip_lps_mm = random_vector(rng);
    Recording expected = recording;
    if (!from_the_start)  // within a chunk either all poses have a place of their own, or none
      for (PoseSample& pose : expected.poses)
        if (pose.t_s >= 2.0 && !pose.rest_tip_lps_mm) pose.rest_tip_lps_mm = pose.tip_lps_mm;
    const auto back = recording_from_chunks(chunks_from_recording(recording));
    ASSERT_TRUE(back.has_value()) << back.error().text;
    expect_same(expected, *back);
  }
}

TEST(Recording, AnUnknownEventIsDamage) {
  Recording recording = random_recording(1500, 18);
  ASSERT_GT(recording.events->size(), 1U);
  recording.events->back().kind = static_cast<EventKind>(31);
  EXPECT_EQ(recording_from_chunks(chunks_from_recording(recording)).error().code, "damaged");
  recording = random_recording(1500, 18);
  recording.inputs[7].event = static_cast<EventKind>(200);
  EXPECT_EQ(recording_from_chunks(chunks_from_recording(recording)).error().code, "damaged");
}

TEST(Recording, OfAnotherFormatIsRefused) {
  const Recording recording = random_recording(100, 13);
  for (const std::uint32_t format : {0U, 10U, 77U})
    EXPECT_EQ(recording_from_chunks(std::vector{chunk_of_format_1(recording, format)}).error().code,
              "recording_version");
  EXPECT_EQ(recording_from_chunks(std::vector{chunk_of_format_1(recording, 1, 1)}).error().code, "damaged")
      << "format 1 had no fluoroscope";
  EXPECT_EQ(recording_from_chunks(std::vector{chunk_of_format_1(recording, 2, 1)}).error().code, "damaged")
      << "its columns are missing";
  EXPECT_EQ(recording_from_chunks(std::vector{chunk_of_format_1(recording, 2, 2)}).error().code, "damaged");
  EXPECT_TRUE(recording_from_chunks(std::vector{chunk_of_format_1(recording, 2, 0)}).has_value());
}

TEST(Recording, EveryDamagedChunkIsRefused) {
  auto chunks = chunks_from_recording(random_recording(2500, 9));
  for (RecordingChunk& chunk : chunks_from_recording(random_xray_recording(1500, 9))) {
    chunk.sequence = 2;
    chunks.push_back(std::move(chunk));
  }
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

TEST(Recording, AHeldPedalIsSmall) {
  Recording recording;
  recording.step_version = 1;
  for (int i = 0; i < 20'000; ++i) {
    Inputs inputs;
    inputs.needle.position_lps_mm = {std::floor(i * 0.032) / 32.0, 10.0, -5.0};
    inputs.fluoroscope.pedal = i > 2000;
    inputs.fluoroscope.collimator = {0.45, 0.45};
    inputs.exposure = {static_cast<std::uint32_t>(i / 133), 0.031 + i / 133 * 1e-4, 2.0, {71.3, 44.1, 8.0}, false};
    recording.inputs.push_back(inputs);
    recording.hashes.push_back(0);
  }
  std::size_t bytes = 0;
  for (const auto& chunk : chunks_from_recording(recording)) bytes += chunk.data.size();
  EXPECT_LT(bytes, 25'000U) << "a fluoroscope adds little to a tick";
}

}  // namespace
}  // namespace seldinger::cases
