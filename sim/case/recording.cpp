#include "sim/case/recording.h"

#include <bit>
#include <cmath>
#include <cstring>

#include "sim/base/codec.h"
#include "sim/base/hash.h"

namespace seldinger::cases {
namespace {

constexpr std::uint32_t kMagic = 0x524c4453;  // "SDLR"
constexpr std::uint32_t kFormat = 1;
constexpr double kChunkSeconds = 2.0;
constexpr std::uint32_t kMaxRows = 1'000'000;  // per chunk: bounds what damaged bytes can make us allocate

struct Header {
  std::uint32_t magic = kMagic, format = kFormat;
  std::uint32_t step_version = 0, inputs = 0, poses = 0, frames = 0, has_endpoint = 0, reserved = 0;
  double dt_s = 0.0;
  double endpoint[7] = {};
};
static_assert(sizeof(Header) == 96);

constexpr std::size_t kInputColumns = 20, kPoseColumns = 16, kFrameColumns = 3;

void put(std::uint64_t*& at, double value) {
  *at++ = std::bit_cast<std::uint64_t>(value);
}
void put(std::uint64_t*& at, const glm::dvec3& p) {
  for (int axis = 0; axis < 3; ++axis) put(at, p[axis]);
}
void put(std::uint64_t*& at, const ToolPose& pose) {
  put(at, pose.position_lps_mm);
  put(at, pose.axis);
  put(at, pose.side);
}
double get(const std::uint64_t*& at) {
  return std::bit_cast<double>(*at++);
}
glm::dvec3 get_point(const std::uint64_t*& at) {
  const double x = get(at), y = get(at), z = get(at);
  return {x, y, z};
}
ToolPose get_pose(const std::uint64_t*& at) {
  ToolPose pose;
  pose.position_lps_mm = get_point(at);
  pose.axis = get_point(at);
  pose.side = get_point(at);
  return pose;
}

// Rows of 64-bit words, written column by column as XOR with the row before and byte plane by byte plane: what
// moves slowly becomes runs of zeros, which is what makes the compression worth it.
void append_table(std::vector<std::byte>& out, const std::vector<std::uint64_t>& rows, std::size_t columns) {
  const std::size_t count = rows.size() / columns;
  const std::size_t start = out.size();
  out.resize(start + rows.size() * 8);
  std::byte* to = out.data() + start;
  for (std::size_t column = 0; column < columns; ++column)
    for (unsigned plane = 0; plane < 64; plane += 8) {
      std::uint64_t before = 0;
      for (std::size_t row = 0; row < count; ++row) {
        const std::uint64_t word = rows[row * columns + column];
        *to++ = static_cast<std::byte>((word ^ before) >> plane);
        before = word;
      }
    }
}

std::vector<std::uint64_t> table_at(const std::byte*& from, std::size_t count, std::size_t columns) {
  std::vector<std::uint64_t> rows(count * columns, 0);
  for (std::size_t column = 0; column < columns; ++column)
    for (unsigned plane = 0; plane < 64; plane += 8) {
      std::uint64_t before = 0;
      for (std::size_t row = 0; row < count; ++row) {
        before ^= static_cast<std::uint64_t>(std::to_integer<unsigned>(*from++));
        rows[row * columns + column] |= before << plane;
      }
    }
  return rows;
}

RecordingChunk make_chunk(const Recording& recording, std::uint32_t sequence, std::size_t first_input,
                          std::size_t end_input, std::size_t first_pose, std::size_t end_pose,
                          std::size_t first_frame, std::size_t end_frame, bool with_endpoint) {
  Header header;
  header.step_version = recording.step_version;
  header.dt_s = recording.dt_s;
  header.inputs = static_cast<std::uint32_t>(end_input - first_input);
  header.poses = static_cast<std::uint32_t>(end_pose - first_pose);
  header.frames = static_cast<std::uint32_t>(end_frame - first_frame);
  if (with_endpoint) {
    const Endpoint& endpoint = *recording.endpoint;
    header.has_endpoint = 1;
    header.endpoint[0] = endpoint.t_s;
    for (int axis = 0; axis < 3; ++axis) {
      header.endpoint[1 + axis] = endpoint.tip_lps_mm[axis];
      header.endpoint[4 + axis] = endpoint.direction[axis];
    }
  }
  std::vector<std::byte> raw(sizeof header);
  std::memcpy(raw.data(), &header, sizeof header);

  std::vector<std::uint64_t> rows(header.inputs * kInputColumns);
  std::uint64_t* at = rows.data();
  for (std::size_t i = first_input; i < end_input; ++i) {
    const Inputs& inputs = recording.inputs[i];
    put(at, inputs.needle);
    put(at, inputs.probe);
    *at++ = (inputs.fire ? 1U : 0U) | (inputs.freeze ? 2U : 0U);
    *at++ = recording.hashes[i];
  }
  append_table(raw, rows, kInputColumns);

  rows.assign(header.poses * kPoseColumns, 0);
  at = rows.data();
  for (std::size_t i = first_pose; i < end_pose; ++i) {
    const PoseSample& pose = recording.poses[i];
    put(at, pose.t_s);
    put(at, pose.tip_lps_mm);
    put(at, pose.needle_direction);
    put(at, pose.probe_origin_lps_mm);
    put(at, pose.probe_axial);
    put(at, pose.probe_lateral);
  }
  append_table(raw, rows, kPoseColumns);

  rows.assign(header.frames * kFrameColumns, 0);
  at = rows.data();
  for (std::size_t i = first_frame; i < end_frame; ++i) {
    const FrameTruth& frame = recording.frames[i];
    put(at, frame.t_s);
    put(at, frame.needle_length_mm);
    *at++ = (frame.live ? 1U : 0U) | (frame.needle_tip ? 2U : 0U) | (frame.target ? 4U : 0U);
  }
  append_table(raw, rows, kFrameColumns);

  RecordingChunk chunk;
  chunk.sequence = sequence;
  chunk.data = base::compress(raw);
  chunk.checksum = base::hash_bytes(chunk.data);
  return chunk;
}

}  // namespace

std::vector<RecordingChunk> chunks_from_recording(const Recording& recording) {
  CHECK(recording.hashes.size() == recording.inputs.size());
  CHECK(recording.dt_s > 0.0);
  const auto ticks_per_chunk = static_cast<std::size_t>(std::ceil(kChunkSeconds / recording.dt_s));
  CHECK(ticks_per_chunk <= kMaxRows);
  std::vector<RecordingChunk> chunks;
  std::size_t pose = 0, frame = 0;
  bool endpoint_left = recording.endpoint.has_value();
  for (std::size_t input = 0; input < recording.inputs.size() || chunks.empty();) {
    const std::size_t end_input = std::min(recording.inputs.size(), input + ticks_per_chunk);
    const bool last = end_input == recording.inputs.size();
    const double end_s = static_cast<double>(end_input) * recording.dt_s;
    std::size_t end_pose = pose, end_frame = frame;
    while (end_pose < recording.poses.size() && (last || recording.poses[end_pose].t_s < end_s)) ++end_pose;
    while (end_frame < recording.frames.size() && (last || recording.frames[end_frame].t_s < end_s)) ++end_frame;
    const bool with_endpoint = endpoint_left && (last || recording.endpoint->t_s < end_s);
    if (with_endpoint) endpoint_left = false;
    chunks.push_back(make_chunk(recording, static_cast<std::uint32_t>(chunks.size()), input, end_input, pose,
                                end_pose, frame, end_frame, with_endpoint));
    input = end_input;
    pose = end_pose;
    frame = end_frame;
    if (last) break;
  }
  return chunks;
}

base::Result<Recording> recording_from_chunks(std::span<const RecordingChunk> chunks) {
  Recording recording;
  if (chunks.empty()) return base::Error{"incomplete", "the recording has no chunks"};
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    const std::string where = "recording chunk " + std::to_string(i);
    if (chunks[i].sequence != i) return base::Error{"incomplete", where + " is missing"};
    if (chunks[i].checksum != base::hash_bytes(chunks[i].data))
      return base::Error{"damaged", where + " does not have its checksum"};
    const auto raw = base::decompress(chunks[i].data, std::size_t{kMaxRows} * 8 * (kInputColumns + kPoseColumns));
    Header header;
    if (!raw || raw->size() < sizeof header) return base::Error{"damaged", where + " cannot be read"};
    std::memcpy(&header, raw->data(), sizeof header);
    if (header.magic != kMagic) return base::Error{"damaged", where + " cannot be read"};
    if (header.format != kFormat) return base::Error{"recording_version", where + " has an unknown format"};
    if (header.inputs > kMaxRows || header.poses > kMaxRows || header.frames > kMaxRows ||
        raw->size() != sizeof header + 8 * (header.inputs * kInputColumns + header.poses * kPoseColumns +
                                            header.frames * kFrameColumns))
      return base::Error{"damaged", where + " has a wrong size"};
    if (i > 0 && (header.step_version != recording.step_version || header.dt_s != recording.dt_s))
      return base::Error{"damaged", where + " belongs to another recording"};
    if (!(header.dt_s > 0.0 && header.dt_s <= 1.0))
      return base::Error{"damaged", where + " has no sound time step"};
    recording.step_version = header.step_version;
    recording.dt_s = header.dt_s;
    if (header.has_endpoint != 0)
      recording.endpoint = Endpoint{header.endpoint[0],
                                    {header.endpoint[1], header.endpoint[2], header.endpoint[3]},
                                    {header.endpoint[4], header.endpoint[5], header.endpoint[6]}};
    const std::byte* from = raw->data() + sizeof header;
    const auto inputs = table_at(from, header.inputs, kInputColumns);
    const std::uint64_t* at = inputs.data();
    for (std::uint32_t row = 0; row < header.inputs; ++row) {
      Inputs& in = recording.inputs.emplace_back();
      in.needle = get_pose(at);
      in.probe = get_pose(at);
      const std::uint64_t bits = *at++;
      in.fire = (bits & 1U) != 0;
      in.freeze = (bits & 2U) != 0;
      recording.hashes.push_back(static_cast<std::uint32_t>(*at++));
    }
    const auto poses = table_at(from, header.poses, kPoseColumns);
    at = poses.data();
    for (std::uint32_t row = 0; row < header.poses; ++row) {
      PoseSample& pose = recording.poses.emplace_back();
      pose.t_s = get(at);
      pose.tip_lps_mm = get_point(at);
      pose.needle_direction = get_point(at);
      pose.probe_origin_lps_mm = get_point(at);
      pose.probe_axial = get_point(at);
      pose.probe_lateral = get_point(at);
    }
    const auto frames = table_at(from, header.frames, kFrameColumns);
    at = frames.data();
    for (std::uint32_t row = 0; row < header.frames; ++row) {
      FrameTruth& frame = recording.frames.emplace_back();
      frame.t_s = get(at);
      frame.needle_length_mm = get(at);
      const std::uint64_t bits = *at++;
      frame.live = (bits & 1U) != 0;
      frame.needle_tip = (bits & 2U) != 0;
      frame.target = (bits & 4U) != 0;
    }
  }
  return recording;
}

}  // namespace seldinger::cases
