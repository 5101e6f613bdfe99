// The tables of a recording's chunk, one function a kind of row and direction: rows become 64-bit words, words
// become bytes that compress well, and back.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/base/result.h"
#include "sim/case/record/recording.h"

namespace seldinger::cases {

// Which optional columns a chunk has, and how its flags are to be read.
struct ChunkLayout {
  bool fluoroscope = false;  // its settings, exposures and beams
  bool moving = false;       // where each tip lies in the patient at rest
  bool console = false;      // how the console was set
  bool colour = false;       // and its colour Doppler
  bool steered = false;      // and which way it looked, and where colour's box stood
  bool listened = true;      // events were recorded
  bool near_plane = true;    // frames say what lies near the picture's plane
  bool pauses = false;       // events say how long by the wall's clock

  std::size_t input_columns() const noexcept;
  std::size_t pose_columns() const noexcept;
  std::size_t frame_columns() const noexcept;
  std::size_t event_columns() const noexcept;
};
constexpr std::size_t kForceColumns = 4, kRestColumns = 3;
constexpr std::size_t kMaxInputColumns = 46, kMaxPoseColumns = 19;

// Rows `first` to `end` of one of a recording's tables.
struct Rows {
  std::size_t first = 0, end = 0;
  std::uint32_t count() const noexcept { return static_cast<std::uint32_t>(end - first); }
};

// Of the console, what only layouts that are steered hold.
std::array<double, 4> steering_of(const ConsoleSetting& console) noexcept;

void append_inputs(const Recording& recording, Rows rows, const ChunkLayout& layout, std::vector<std::byte>& out);
void append_poses(const Recording& recording, Rows rows, const ChunkLayout& layout, std::vector<std::byte>& out);
void append_forces(const Recording& recording, Rows rows, std::vector<std::byte>& out);
void append_frames(const Recording& recording, Rows rows, const ChunkLayout& layout, std::vector<std::byte>& out);
void append_events(const Recording& recording, Rows rows, const ChunkLayout& layout, std::vector<std::byte>& out);
void append_endpoint_at_rest(const Recording& recording, std::vector<std::byte>& out);

// Each adds `count` rows to the recording and moves `from` past their bytes, all of which must be there. Refused
// (`damaged`): an unknown event, a pause without a sound length.
base::Result<void> read_inputs(const std::byte*& from, std::size_t count, const ChunkLayout& layout,
                               Recording& recording);
void read_poses(const std::byte*& from, std::size_t count, const ChunkLayout& layout, Recording& recording);
void read_forces(const std::byte*& from, std::size_t count, Recording& recording);
void read_frames(const std::byte*& from, std::size_t count, const ChunkLayout& layout, Recording& recording);
base::Result<void> read_events(const std::byte*& from, std::size_t count, const ChunkLayout& layout,
                               Recording& recording);
void read_endpoint_at_rest(const std::byte*& from, Recording& recording);

}  // namespace seldinger::cases
