#include "sim/case/recording.h"

#include <bit>
#include <cmath>
#include <cstring>

#include "sim/base/codec.h"
#include "sim/base/hash.h"

namespace seldinger::cases {
namespace {

constexpr std::uint32_t kMagic = 0x524c4453;  // "SDLR"
constexpr std::uint32_t kFormat = 6, kFormatWithoutConsole = 5, kFormatWithoutEvents = 4, kFormatWithoutForces = 3,
                        kFormatWithoutNearPlane = 2, kFormatWithoutFluoroscope = 1;
constexpr std::uint32_t kMaxRows = 50'000;  // per chunk, 25 kHz: bounds what damaged bytes can make us allocate

constexpr std::uint32_t kNotListened = 0xffff'ffff;

struct Header {
  std::uint32_t magic = kMagic, format = kFormat;
  std::uint32_t step_version = 0, inputs = 0, poses = 0, frames = 0, has_endpoint = 0;
  std::uint32_t used = 0;  // UsedBit, or-ed; before format 5: of the fluoroscope alone
  double dt_s = 0.0;
  double endpoint[7] = {};
  std::uint32_t forces = 0;             // from here on since format 4
  std::uint32_t events = kNotListened;  // since format 5; 0 before
};
static_assert(sizeof(Header) == 104);
constexpr std::size_t kHeaderWithoutForces = 96;

enum UsedBit : std::uint32_t { kFluoroscope = 1, kMoves = 2, kConsole = 4 };

constexpr std::size_t kMaxPoseColumns = 19, kRestColumns = 3, kForceColumns = 4, kEventColumns = 2;
constexpr std::size_t kInputColumns = 20, kFluoroscopeColumns = 17, kConsoleColumns = 4;
constexpr std::size_t kMaxInputColumns = kInputColumns + kFluoroscopeColumns + kConsoleColumns;
std::size_t pose_columns(bool moves) {
  return moves ? kMaxPoseColumns : 16;
}
std::size_t input_columns(bool fluoroscope, bool console) {
  return kInputColumns + (fluoroscope ? kFluoroscopeColumns : 0) + (console ? kConsoleColumns : 0);
}
std::size_t frame_columns(bool fluoroscope) {
  return fluoroscope ? 11 : 3;
}

// Bits of a row's one word of yes and no.
enum InputBit : unsigned { kFire = 1, kFreeze = 2, kPedal = 4, kAutomatic = 8, kHandAway = 16, kHandInBeam = 32 };
constexpr unsigned kEventShift = 8;  // its kind, eight bits
enum FrameBit : unsigned {
  kLive = 1,
  kNeedleTip = 2,
  kTarget = 4,
  kBeam = 8,
  kArmMoving = 16,
  kHand = 32,
  kNearPlane = 64,
  kTip2Mm = 128,
  kTarget2Mm = 256,
  kTip5Mm = 512,
  kTarget5Mm = 1024
};

std::uint64_t bits_of(const std::optional<NearPlane>& near_plane) {
  if (!near_plane) return 0;
  return kNearPlane | (near_plane->tip_2_mm ? kTip2Mm : 0U) | (near_plane->target_2_mm ? kTarget2Mm : 0U) |
         (near_plane->tip_5_mm ? kTip5Mm : 0U) | (near_plane->target_5_mm ? kTarget5Mm : 0U);
}
std::optional<NearPlane> near_plane_of(std::uint64_t bits) {
  if ((bits & kNearPlane) == 0) return std::nullopt;
  return NearPlane{(bits & kTip2Mm) != 0, (bits & kTarget2Mm) != 0, (bits & kTip5Mm) != 0,
                   (bits & kTarget5Mm) != 0};
}

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

void put(std::uint64_t*& at, const FluoroscopeInputs& asked, const ExposureReport& report) {
  for (const double speed : {asked.lao_speed, asked.cranial_speed, asked.sid_speed}) put(at, speed);
  put(at, asked.table_speed);
  for (const double value : {asked.collimator.open_u, asked.collimator.open_v, asked.kv, asked.ma}) put(at, value);
  *at++ = std::uint64_t{static_cast<std::uint32_t>(asked.magnification)} << 32U |
          std::uint64_t{static_cast<std::uint32_t>(asked.pulse_rate)};
  *at++ = report.frame;
  for (const double value :
       {report.air_kerma_mgy, report.dap_mgy_cm2, report.next.kv, report.next.ma, report.next.pulse_ms})
    put(at, value);
}
void get(const std::uint64_t*& at, FluoroscopeInputs& asked, ExposureReport& report) {
  for (double* speed : {&asked.lao_speed, &asked.cranial_speed, &asked.sid_speed}) *speed = get(at);
  asked.table_speed = get_point(at);
  for (double* value : {&asked.collimator.open_u, &asked.collimator.open_v, &asked.kv, &asked.ma}) *value = get(at);
  const std::uint64_t settings = *at++;
  asked.magnification = static_cast<int>(static_cast<std::uint32_t>(settings >> 32U));
  asked.pulse_rate = static_cast<int>(static_cast<std::uint32_t>(settings));
  report.frame = static_cast<std::uint32_t>(*at++);
  for (double* value :
       {&report.air_kerma_mgy, &report.dap_mgy_cm2, &report.next.kv, &report.next.ma, &report.next.pulse_ms})
    *value = get(at);
}

void put(std::uint64_t*& at, const ConsoleSetting& console) {
  for (const double value : {console.depth_mm, console.focus_mm, console.frequency_mhz, console.slice_mm})
    put(at, value);
}
ConsoleSetting get_console(const std::uint64_t*& at) {
  ConsoleSetting console;
  for (double* value : {&console.depth_mm, &console.focus_mm, &console.frequency_mhz, &console.slice_mm})
    *value = get(at);
  return console;
}

void put(std::uint64_t*& at, const BeamTruth& beam) {
  for (const double value : {beam.lao_deg, beam.cranial_deg, beam.kv, beam.ma, beam.air_kerma_mgy, beam.dap_mgy_cm2,
                             beam.collimated_share, beam.beam_s})
    put(at, value);
}
BeamTruth get_beam(const std::uint64_t*& at) {
  BeamTruth beam;
  for (double* value : {&beam.lao_deg, &beam.cranial_deg, &beam.kv, &beam.ma, &beam.air_kerma_mgy,
                        &beam.dap_mgy_cm2, &beam.collimated_share, &beam.beam_s})
    *value = get(at);
  return beam;
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

// Rows first to end of one of a recording's tables.
struct Rows {
  std::size_t first = 0, end = 0;
  std::uint32_t count() const { return static_cast<std::uint32_t>(end - first); }
};

struct Piece {
  Rows inputs, poses, forces, frames, events;
  bool with_endpoint = false;
};

// Whether a chunk holds anything of a fluoroscope.
bool uses_fluoroscope(const Recording& recording, const Piece& piece) {
  for (std::size_t i = piece.inputs.first; i < piece.inputs.end; ++i)
    if (!(recording.inputs[i].fluoroscope == FluoroscopeInputs{} &&
          recording.inputs[i].exposure == ExposureReport{}))
      return true;
  for (std::size_t i = piece.frames.first; i < piece.frames.end; ++i)
    if (recording.frames[i].beam) return true;
  return false;
}

// Whether the console was touched in a chunk, or was before.
bool turns_console(const Recording& recording, const Piece& piece) {
  for (std::size_t i = piece.inputs.first; i < piece.inputs.end; ++i)
    if (!(recording.inputs[i].console == ConsoleSetting{})) return true;
  return false;
}

// Whether the patient moves in a chunk: then every tip has a place at rest of its own.
bool moves(const Recording& recording, const Piece& piece) {
  for (std::size_t i = piece.poses.first; i < piece.poses.end; ++i)
    if (recording.poses[i].rest_tip_lps_mm) return true;
  return piece.with_endpoint && recording.endpoint->rest_tip_lps_mm;
}

RecordingChunk make_chunk(const Recording& recording, std::uint32_t sequence, const Piece& piece) {
  Header header;
  header.step_version = recording.step_version;
  header.dt_s = recording.dt_s;
  header.inputs = piece.inputs.count();
  header.poses = piece.poses.count();
  header.forces = piece.forces.count();
  header.frames = piece.frames.count();
  if (recording.events) header.events = piece.events.count();
  if (piece.with_endpoint) {
    const Endpoint& endpoint = *recording.endpoint;
    header.has_endpoint = 1;
    header.endpoint[0] = endpoint.t_s;
    for (int axis = 0; axis < 3; ++axis) {
      header.endpoint[1 + axis] = endpoint.tip_lps_mm[axis];
      header.endpoint[4 + axis] = endpoint.direction[axis];
    }
  }
  const bool fluoroscope = uses_fluoroscope(recording, piece);
  const bool moving = moves(recording, piece);
  const bool console = turns_console(recording, piece);
  header.used = (fluoroscope ? kFluoroscope : 0U) | (moving ? kMoves : 0U) | (console ? kConsole : 0U);
  std::vector<std::byte> raw(sizeof header);
  std::memcpy(raw.data(), &header, sizeof header);

  std::vector<std::uint64_t> rows(header.inputs * input_columns(fluoroscope, console));
  std::uint64_t* at = rows.data();
  for (std::size_t i = piece.inputs.first; i < piece.inputs.end; ++i) {
    const Inputs& inputs = recording.inputs[i];
    const FluoroscopeInputs& asked = inputs.fluoroscope;
    put(at, inputs.needle);
    put(at, inputs.probe);
    *at++ = (inputs.fire ? kFire : 0U) | (inputs.freeze ? kFreeze : 0U) | (asked.pedal ? kPedal : 0U) |
            (fluoroscope && asked.automatic_exposure ? kAutomatic : 0U) | (asked.hand_away ? kHandAway : 0U) |
            (inputs.exposure.hand_in_beam ? kHandInBeam : 0U) |
            std::uint64_t{static_cast<std::uint8_t>(inputs.event)} << kEventShift;
    *at++ = recording.hashes[i];
    if (fluoroscope) put(at, asked, inputs.exposure);
    if (console) put(at, inputs.console);
  }
  append_table(raw, rows, input_columns(fluoroscope, console));

  rows.assign(header.poses * pose_columns(moving), 0);
  at = rows.data();
  for (std::size_t i = piece.poses.first; i < piece.poses.end; ++i) {
    const PoseSample& pose = recording.poses[i];
    put(at, pose.t_s);
    put(at, pose.tip_lps_mm);
    put(at, pose.needle_direction);
    put(at, pose.probe_origin_lps_mm);
    put(at, pose.probe_axial);
    put(at, pose.probe_lateral);
    if (moving) put(at, pose.tip_at_rest_lps_mm());
  }
  append_table(raw, rows, pose_columns(moving));

  rows.assign(header.forces * kForceColumns, 0);
  at = rows.data();
  for (std::size_t i = piece.forces.first; i < piece.forces.end; ++i) {
    const ForceSample& force = recording.forces[i];
    for (const double value : {force.t_s, force.needle_axial_n, force.needle_lateral_n, force.probe_n})
      put(at, value);
  }
  append_table(raw, rows, kForceColumns);

  rows.assign(header.frames * frame_columns(fluoroscope), 0);
  at = rows.data();
  for (std::size_t i = piece.frames.first; i < piece.frames.end; ++i) {
    const FrameTruth& frame = recording.frames[i];
    put(at, frame.t_s);
    put(at, frame.needle_length_mm);
    const BeamTruth beam = frame.beam.value_or(BeamTruth{});
    *at++ = (frame.live ? kLive : 0U) | (frame.needle_tip ? kNeedleTip : 0U) | (frame.target ? kTarget : 0U) |
            (frame.beam ? kBeam : 0U) | (beam.arm_moving ? kArmMoving : 0U) | (beam.hand_in_beam ? kHand : 0U) |
            bits_of(frame.near_plane);
    if (fluoroscope) put(at, beam);
  }
  append_table(raw, rows, frame_columns(fluoroscope));

  rows.assign(piece.events.count() * kEventColumns, 0);
  at = rows.data();
  for (std::size_t i = piece.events.first; i < piece.events.end; ++i) {
    put(at, (*recording.events)[i].t_s);
    *at++ = static_cast<std::uint8_t>((*recording.events)[i].kind);
  }
  append_table(raw, rows, kEventColumns);

  if (moving && piece.with_endpoint) {
    rows.assign(kRestColumns, 0);
    at = rows.data();
    put(at, recording.endpoint->tip_at_rest_lps_mm());
    append_table(raw, rows, kRestColumns);
  }

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
  Piece piece;
  bool endpoint_left = recording.endpoint.has_value(), last = false;
  while (!last) {
    piece.inputs = {piece.inputs.end, std::min(recording.inputs.size(), piece.inputs.end + ticks_per_chunk)};
    last = piece.inputs.end == recording.inputs.size();
    const double end_s = static_cast<double>(piece.inputs.end) * recording.dt_s;
    const auto advance = [&](Rows& rows, const auto& table) {
      rows.first = rows.end;
      while (rows.end < table.size() && (last || table[rows.end].t_s < end_s)) ++rows.end;
    };
    advance(piece.poses, recording.poses);
    advance(piece.forces, recording.forces);
    advance(piece.frames, recording.frames);
    if (recording.events) advance(piece.events, *recording.events);
    piece.with_endpoint = endpoint_left && (last || recording.endpoint->t_s < end_s);
    if (piece.with_endpoint) endpoint_left = false;
    chunks.push_back(make_chunk(recording, static_cast<std::uint32_t>(chunks.size()), piece));
  }
  return chunks;
}

RecordingChunk chunk_of(const Recording& piece, std::uint32_t sequence) {
  CHECK(piece.hashes.size() == piece.inputs.size());
  CHECK(piece.dt_s > 0.0);
  CHECK(piece.inputs.size() <= kMaxRows && piece.frames.size() <= kMaxRows);
  const std::size_t events = piece.events ? piece.events->size() : 0;
  CHECK(events <= kMaxRows);
  return make_chunk(piece, sequence,
                    {{0, piece.inputs.size()},
                     {0, piece.poses.size()},
                     {0, piece.forces.size()},
                     {0, piece.frames.size()},
                     {0, events},
                     piece.endpoint.has_value()});
}

base::Result<Recording> recording_from_chunks(std::span<const RecordingChunk> chunks) {
  Recording recording;
  if (chunks.empty()) return base::Error{"incomplete", "the recording has no chunks"};
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    const std::string where = "recording chunk " + std::to_string(i);
    if (chunks[i].sequence != i) return base::Error{"incomplete", where + " is missing"};
    if (chunks[i].checksum != base::hash_bytes(chunks[i].data))
      return base::Error{"damaged", where + " does not have its checksum"};
    const auto raw =
        base::decompress(chunks[i].data, std::size_t{kMaxRows} * 8 * (kMaxInputColumns + kMaxPoseColumns));
    Header header;
    if (!raw || raw->size() < kHeaderWithoutForces) return base::Error{"damaged", where + " cannot be read"};
    std::memcpy(static_cast<void*>(&header), raw->data(), kHeaderWithoutForces);
    const std::size_t header_size = header.format > kFormatWithoutForces ? sizeof header : kHeaderWithoutForces;
    if (raw->size() < header_size) return base::Error{"damaged", where + " cannot be read"};
    std::memcpy(static_cast<void*>(&header), raw->data(), header_size);
    if (header.magic != kMagic) return base::Error{"damaged", where + " cannot be read"};
    if (header.format < kFormatWithoutFluoroscope || header.format > kFormat)
      return base::Error{"recording_version", where + " has an unknown format"};
    if (header.used > (header.format == kFormatWithoutFluoroscope ? 0U
                       : header.format <= kFormatWithoutEvents    ? std::uint32_t{kFluoroscope}
                       : header.format <= kFormatWithoutConsole   ? kFluoroscope | kMoves
                                                                  : kFluoroscope | kMoves | kConsole))
      return base::Error{"damaged", where + " cannot be read"};
    const bool fluoroscope = (header.used & kFluoroscope) != 0, moving = (header.used & kMoves) != 0,
               console = (header.used & kConsole) != 0;
    const std::uint32_t rests = moving && header.has_endpoint != 0 ? 1 : 0;
    if (header.format <= kFormatWithoutEvents) header.events = kNotListened;
    const bool listened = header.events != kNotListened;
    const std::uint32_t events = listened ? header.events : 0;
    if (header.inputs > kMaxRows || header.poses > kMaxRows || header.frames > kMaxRows ||
        header.forces > kMaxRows || events > kMaxRows ||
        raw->size() != header_size + 8 * (header.inputs * input_columns(fluoroscope, console) +
                                          header.poses * pose_columns(moving) + header.forces * kForceColumns +
                                          header.frames * frame_columns(fluoroscope) + events * kEventColumns +
                                          rests * kRestColumns))
      return base::Error{"damaged", where + " has a wrong size"};
    if (i > 0 && (header.step_version != recording.step_version || header.dt_s != recording.dt_s ||
                  listened != recording.events.has_value()))
      return base::Error{"damaged", where + " belongs to another recording"};
    if (!(header.dt_s > 0.0 && header.dt_s <= 1.0))
      return base::Error{"damaged", where + " has no sound time step"};
    recording.step_version = header.step_version;
    recording.dt_s = header.dt_s;
    if (listened && !recording.events) recording.events.emplace();
    if (header.has_endpoint != 0)
      recording.endpoint = Endpoint{header.endpoint[0],
                                    {header.endpoint[1], header.endpoint[2], header.endpoint[3]},
                                    {header.endpoint[4], header.endpoint[5], header.endpoint[6]},
                                    {}};
    const std::byte* from = raw->data() + header_size;
    const auto inputs = table_at(from, header.inputs, input_columns(fluoroscope, console));
    const std::uint64_t* at = inputs.data();
    for (std::uint32_t row = 0; row < header.inputs; ++row) {
      Inputs& in = recording.inputs.emplace_back();
      in.needle = get_pose(at);
      in.probe = get_pose(at);
      const std::uint64_t bits = *at++;
      in.fire = (bits & kFire) != 0;
      in.freeze = (bits & kFreeze) != 0;
      if (listened) {
        in.event = static_cast<EventKind>(bits >> kEventShift & 0xffU);
        if (in.event != EventKind::none && find_event(in.event) == nullptr)
          return base::Error{"damaged", where + " holds an unknown event"};
      }
      recording.hashes.push_back(static_cast<std::uint32_t>(*at++));
      if (fluoroscope) {
        in.fluoroscope.pedal = (bits & kPedal) != 0;
        in.fluoroscope.automatic_exposure = (bits & kAutomatic) != 0;
        in.fluoroscope.hand_away = (bits & kHandAway) != 0;
        in.exposure.hand_in_beam = (bits & kHandInBeam) != 0;
        get(at, in.fluoroscope, in.exposure);
      }
      if (console) in.console = get_console(at);
    }
    const auto poses = table_at(from, header.poses, pose_columns(moving));
    at = poses.data();
    for (std::uint32_t row = 0; row < header.poses; ++row) {
      PoseSample& pose = recording.poses.emplace_back();
      pose.t_s = get(at);
      pose.tip_lps_mm = get_point(at);
      pose.needle_direction = get_point(at);
      pose.probe_origin_lps_mm = get_point(at);
      pose.probe_axial = get_point(at);
      pose.probe_lateral = get_point(at);
      if (moving) pose.rest_tip_lps_mm = get_point(at);
    }
    const auto forces = table_at(from, header.forces, kForceColumns);
    at = forces.data();
    for (std::uint32_t row = 0; row < header.forces; ++row) {
      ForceSample& force = recording.forces.emplace_back();
      for (double* value : {&force.t_s, &force.needle_axial_n, &force.needle_lateral_n, &force.probe_n})
        *value = get(at);
    }
    const auto frames = table_at(from, header.frames, frame_columns(fluoroscope));
    at = frames.data();
    for (std::uint32_t row = 0; row < header.frames; ++row) {
      FrameTruth& frame = recording.frames.emplace_back();
      frame.t_s = get(at);
      frame.needle_length_mm = get(at);
      const std::uint64_t bits = *at++;
      frame.live = (bits & kLive) != 0;
      frame.needle_tip = (bits & kNeedleTip) != 0;
      frame.target = (bits & kTarget) != 0;
      if (header.format > kFormatWithoutNearPlane) frame.near_plane = near_plane_of(bits);
      if (!fluoroscope) continue;
      const BeamTruth beam = get_beam(at);
      if ((bits & kBeam) == 0) continue;
      frame.beam = beam;
      frame.beam->arm_moving = (bits & kArmMoving) != 0;
      frame.beam->hand_in_beam = (bits & kHand) != 0;
    }
    const auto said = table_at(from, events, kEventColumns);
    at = said.data();
    for (std::uint32_t row = 0; row < events; ++row) {
      Event& event = recording.events->emplace_back();
      event.t_s = get(at);
      const std::uint64_t kind = *at++;
      event.kind = static_cast<EventKind>(kind);
      if (kind > 0xffU || find_event(event.kind) == nullptr)
        return base::Error{"damaged", where + " holds an unknown event"};
    }
    const auto rest = table_at(from, rests, kRestColumns);
    at = rest.data();
    if (rests > 0) recording.endpoint->rest_tip_lps_mm = get_point(at);
  }
  return recording;
}

}  // namespace seldinger::cases
