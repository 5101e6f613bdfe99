// Damaged recordings: refused or read, never a crash, and never much more memory than an honest one takes.
#include <cstring>

#include "sim/base/codec.h"
#include "sim/base/hash.h"
#include "sim/case/record/recording.h"
#include "tests/fixtures/allocations.h"
#include "tests/fixtures/mutate.h"

#include <gtest/gtest.h>

namespace seldinger::cases {
namespace {

constexpr std::size_t kHeaderBytes = 104;  // of an unpacked chunk; then its rows

std::string text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
std::vector<std::byte> bytes_of(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

Recording some_recording(bool fluoroscope) {
  base::Rng rng(11);
  Recording recording;
  recording.step_version = 5;
  for (int tick = 0; tick < 5000; ++tick) {
    Inputs& in = recording.inputs.emplace_back();
    in.needle.position_lps_mm = {rng.normal(), rng.normal(), rng.normal()};
    in.fluoroscope.pedal = fluoroscope && tick % 7 == 0;
    recording.hashes.push_back(static_cast<std::uint32_t>(rng.bits()));
    if (tick % 10 == 0) recording.poses.push_back({tick * 0.001, {}, {}, {}, {}, {}});
    if (tick % 40 == 0) {
      FrameTruth& frame = recording.frames.emplace_back();
      frame.t_s = tick * 0.001;
      if (fluoroscope) frame.beam = BeamTruth{};
    }
  }
  recording.endpoint = Endpoint{4.9, {1, 2, 3}, {0, 0, 1}};
  return recording;
}

// Reads and tells the most memory that took, beside what was there before.
std::size_t most_bytes(const std::vector<RecordingChunk>& chunks, int& read, int& refused) {
  const std::size_t before = fixtures::live_bytes();
  fixtures::forget_peak();
  const auto recording = recording_from_chunks(chunks);
  if (recording) {
    ++read;
    EXPECT_EQ(recording->hashes.size(), recording->inputs.size());
  } else {
    ++refused;
    const std::string& code = recording.error().code;
    EXPECT_TRUE(code == "damaged" || code == "incomplete" || code == "recording_version") << code;
  }
  return fixtures::peak_bytes() - before;
}

TEST(RecordingFuzz, DamageIsRefusedWithinBounds) {
  base::Rng rng(2025);
  int read = 0, refused = 0;
  for (const bool fluoroscope : {false, true}) {
    const std::vector<RecordingChunk> good = chunks_from_recording(some_recording(fluoroscope));
    ASSERT_EQ(good.size(), 3U);
    ASSERT_TRUE(recording_from_chunks(good).has_value());
    const std::size_t honest = most_bytes(good, read, refused);
    const std::size_t bound = 2 * honest + (std::size_t{64} << 20);
    for (int round = 0; round < fixtures::fuzz_rounds(2000); ++round) {
      std::vector<RecordingChunk> chunks = good;
      RecordingChunk& chunk = chunks[fixtures::any_below(rng, chunks.size())];
      switch (fixtures::any_below(rng, 4)) {
        case 0: {  // as a disk does it
          std::string text = text_of(chunk.data);
          fixtures::mutate(text, rng);
          chunk.data = bytes_of(text);
          break;
        }
        case 1: {  // and with a checksum that fits
          std::string text = text_of(chunk.data);
          fixtures::mutate(text, rng);
          chunk.data = bytes_of(text);
          chunk.checksum = base::hash_bytes(chunk.data);
          break;
        }
        case 2: {  // the header inside, which says how much there is
          std::string text = text_of(base::decompress(chunk.data, std::size_t{1} << 30).value());
          std::string head = text.substr(0, kHeaderBytes);
          fixtures::mutate(head, rng);
          head.append(text, kHeaderBytes);
          text = std::move(head);
          chunk.data = base::compress(bytes_of(text));
          chunk.checksum = base::hash_bytes(chunk.data);
          break;
        }
        default:  // pieces in a wrong order, twice, or missing
          if (rng.uniform() < 0.5)
            std::swap(chunk, chunks.front());
          else
            chunks.erase(chunks.begin() + static_cast<std::ptrdiff_t>(fixtures::any_below(rng, chunks.size())));
          break;
      }
      ASSERT_LE(most_bytes(chunks, read, refused), bound) << "round " << round;
    }
  }
  EXPECT_GT(refused, read) << "most damage is noticed";
  EXPECT_GT(read, 2);  // and a header's spare bits are not
}

// A chunk of nothing but zeros whose header says that it holds as much as any may.
TEST(RecordingFuzz, ALieAboutTheSizeCostsNoMemory) {
  const std::vector<RecordingChunk> good = chunks_from_recording(some_recording(false));
  int read = 0, refused = 0;
  const std::size_t bound = 2 * most_bytes(good, read, refused) + (std::size_t{64} << 20);
  for (const std::uint32_t rows : {50'000U, 50'001U, 1'000'000U, 0xffffffffU}) {
    std::string text = text_of(base::decompress(good[0].data, std::size_t{1} << 30).value());
    std::memcpy(text.data() + 12, &rows, sizeof rows);
    for (const std::size_t size : {text.size(), kHeaderBytes + std::size_t{400} * 1024 * 1024}) {
      text.resize(size, '\0');
      std::vector<RecordingChunk> chunks = good;
      chunks[0].data = base::compress(bytes_of(text));
      chunks[0].checksum = base::hash_bytes(chunks[0].data);
      ASSERT_LE(most_bytes(chunks, read, refused), bound) << rows << " rows";
    }
  }
  EXPECT_EQ(read, 1);
}

}  // namespace
}  // namespace seldinger::cases
