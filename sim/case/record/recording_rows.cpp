#include "sim/case/record/recording_rows.h"

#include <bit>
#include <cmath>

namespace seldinger::cases {
namespace {

constexpr std::size_t kInputColumns = 20, kFluoroscopeColumns = 17, kConsoleColumns = 4, kColourColumns = 1,
                      kSteeredColumns = 4;
static_assert(kMaxInputColumns ==
              kInputColumns + kFluoroscopeColumns + kConsoleColumns + kColourColumns + kSteeredColumns);

// The flags of a row share one word.
enum InputBit : unsigned { kFire = 1, kFreeze = 2, kPedal = 4, kAutomatic = 8, kHandAway = 16, kHandInBeam = 32 };
constexpr unsigned kEventShift = 8;         // the event's kind, eight bits …
constexpr unsigned kEventLengthShift = 16;  // … and its length, sixteen; 0 in recordings that knew of none
constexpr unsigned kLengthShift = 8;        // of a row of an event
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

// Rows of 64-bit words, written column by column as XOR with the row before and byte plane by byte plane: slowly
// changing values become runs of zeros, which compress well. A column's eight planes are walked side by side: a
// row's word, a cache line of its own, is then touched once and not eight times.
constexpr std::size_t kPlanes = 8;

void append_table(std::vector<std::byte>& out, const std::vector<std::uint64_t>& rows, std::size_t columns) {
  const std::size_t count = rows.size() / columns;
  const std::size_t start = out.size();
  out.resize(start + rows.size() * kPlanes);
  std::byte* to = out.data() + start;
  for (std::size_t column = 0; column < columns; ++column, to += count * kPlanes) {
    std::uint64_t before = 0;
    for (std::size_t row = 0; row < count; ++row) {
      const std::uint64_t word = rows[row * columns + column];
      for (std::size_t plane = 0; plane < kPlanes; ++plane)
        to[plane * count + row] = static_cast<std::byte>((word ^ before) >> (8 * plane));
      before = word;
    }
  }
}

std::vector<std::uint64_t> table_at(const std::byte*& from, std::size_t count, std::size_t columns) {
  std::vector<std::uint64_t> rows(count * columns);
  for (std::size_t column = 0; column < columns; ++column, from += count * kPlanes) {
    std::uint64_t word = 0;
    for (std::size_t row = 0; row < count; ++row) {
      for (std::size_t plane = 0; plane < kPlanes; ++plane)
        word ^= std::to_integer<std::uint64_t>(from[plane * count + row]) << (8 * plane);
      rows[row * columns + column] = word;
    }
  }
  return rows;
}

base::Error unknown_event() {
  return {"damaged", "holds an unknown event"};
}

}  // namespace

std::size_t ChunkLayout::input_columns() const noexcept {
  return kInputColumns + (fluoroscope ? kFluoroscopeColumns : 0) + (console ? kConsoleColumns : 0) +
         (colour ? kColourColumns : 0) + (steered ? kSteeredColumns : 0);
}

std::size_t ChunkLayout::pose_columns() const noexcept {
  return moving ? kMaxPoseColumns : kMaxPoseColumns - kRestColumns;
}

std::size_t ChunkLayout::frame_columns() const noexcept {
  return fluoroscope ? 11 : 3;
}

std::size_t ChunkLayout::event_columns() const noexcept {
  return pauses ? 3 : 2;
}

std::array<double, 4> steering_of(const ConsoleSetting& console) noexcept {
  return {console.compound_deg, console.lean_deg, console.box_across, console.box_down};
}

void append_inputs(const Recording& recording, Rows rows, const ChunkLayout& layout, std::vector<std::byte>& out) {
  std::vector<std::uint64_t> words(rows.count() * layout.input_columns());
  std::uint64_t* at = words.data();
  for (std::size_t i = rows.first; i < rows.end; ++i) {
    const Inputs& inputs = recording.inputs[i];
    const FluoroscopeInputs& asked = inputs.fluoroscope;
    put(at, inputs.needle);
    put(at, inputs.probe);
    *at++ = (inputs.fire ? kFire : 0U) | (inputs.freeze ? kFreeze : 0U) | (asked.pedal ? kPedal : 0U) |
            (layout.fluoroscope && asked.automatic_exposure ? kAutomatic : 0U) |
            (asked.hand_away ? kHandAway : 0U) | (inputs.exposure.hand_in_beam ? kHandInBeam : 0U) |
            std::uint64_t{static_cast<std::uint8_t>(inputs.event)} << kEventShift |
            std::uint64_t{inputs.event_tenths_mm} << kEventLengthShift;
    *at++ = recording.hashes[i];
    if (layout.fluoroscope) put(at, asked, inputs.exposure);
    if (layout.console) put(at, inputs.console);
    if (layout.colour) put(at, inputs.console.colour_mm_s);
    if (layout.steered)
      for (const double value : steering_of(inputs.console)) put(at, value);
  }
  append_table(out, words, layout.input_columns());
}

void append_poses(const Recording& recording, Rows rows, const ChunkLayout& layout, std::vector<std::byte>& out) {
  std::vector<std::uint64_t> words(rows.count() * layout.pose_columns());
  std::uint64_t* at = words.data();
  for (std::size_t i = rows.first; i < rows.end; ++i) {
    const PoseSample& pose = recording.poses[i];
    put(at, pose.t_s);
    put(at, pose.tip_lps_mm);
    put(at, pose.needle_direction);
    put(at, pose.probe_origin_lps_mm);
    put(at, pose.probe_axial);
    put(at, pose.probe_lateral);
    if (layout.moving) put(at, pose.tip_at_rest_lps_mm());
  }
  append_table(out, words, layout.pose_columns());
}

void append_forces(const Recording& recording, Rows rows, std::vector<std::byte>& out) {
  std::vector<std::uint64_t> words(rows.count() * kForceColumns);
  std::uint64_t* at = words.data();
  for (std::size_t i = rows.first; i < rows.end; ++i) {
    const ForceSample& force = recording.forces[i];
    for (const double value : {force.t_s, force.needle_axial_n, force.needle_lateral_n, force.probe_n})
      put(at, value);
  }
  append_table(out, words, kForceColumns);
}

void append_frames(const Recording& recording, Rows rows, const ChunkLayout& layout, std::vector<std::byte>& out) {
  std::vector<std::uint64_t> words(rows.count() * layout.frame_columns());
  std::uint64_t* at = words.data();
  for (std::size_t i = rows.first; i < rows.end; ++i) {
    const FrameTruth& frame = recording.frames[i];
    put(at, frame.t_s);
    put(at, frame.needle_length_mm);
    const BeamTruth beam = frame.beam.value_or(BeamTruth{});
    *at++ = (frame.live ? kLive : 0U) | (frame.needle_tip ? kNeedleTip : 0U) | (frame.target ? kTarget : 0U) |
            (frame.beam ? kBeam : 0U) | (beam.arm_moving ? kArmMoving : 0U) | (beam.hand_in_beam ? kHand : 0U) |
            bits_of(frame.near_plane);
    if (layout.fluoroscope) put(at, beam);
  }
  append_table(out, words, layout.frame_columns());
}

void append_events(const Recording& recording, Rows rows, const ChunkLayout& layout, std::vector<std::byte>& out) {
  std::vector<std::uint64_t> words(rows.count() * layout.event_columns());
  std::uint64_t* at = words.data();
  for (std::size_t i = rows.first; i < rows.end; ++i) {
    const Event& event = (*recording.events)[i];
    put(at, event.t_s);
    *at++ = static_cast<std::uint8_t>(event.kind) | std::uint64_t{event.tenths_mm} << kLengthShift;
    if (layout.pauses) put(at, event.wall_s);
  }
  append_table(out, words, layout.event_columns());
}

void append_endpoint_at_rest(const Recording& recording, std::vector<std::byte>& out) {
  std::vector<std::uint64_t> words(kRestColumns);
  std::uint64_t* at = words.data();
  put(at, recording.endpoint->tip_at_rest_lps_mm());
  append_table(out, words, kRestColumns);
}

base::Result<void> read_inputs(const std::byte*& from, std::size_t count, const ChunkLayout& layout,
                               Recording& recording) {
  const auto words = table_at(from, count, layout.input_columns());
  const std::uint64_t* at = words.data();
  for (std::size_t row = 0; row < count; ++row) {
    Inputs& in = recording.inputs.emplace_back();
    in.needle = get_pose(at);
    in.probe = get_pose(at);
    const std::uint64_t bits = *at++;
    in.fire = (bits & kFire) != 0;
    in.freeze = (bits & kFreeze) != 0;
    if (layout.listened) {
      in.event = static_cast<EventKind>(bits >> kEventShift & 0xffU);
      in.event_tenths_mm = static_cast<std::uint16_t>(bits >> kEventLengthShift & 0xffffU);
      if (in.event != EventKind::none && find_event(in.event) == nullptr) return unknown_event();
    }
    recording.hashes.push_back(static_cast<std::uint32_t>(*at++));
    if (layout.fluoroscope) {
      in.fluoroscope.pedal = (bits & kPedal) != 0;
      in.fluoroscope.automatic_exposure = (bits & kAutomatic) != 0;
      in.fluoroscope.hand_away = (bits & kHandAway) != 0;
      in.exposure.hand_in_beam = (bits & kHandInBeam) != 0;
      get(at, in.fluoroscope, in.exposure);
    }
    if (layout.console) in.console = get_console(at);
    if (layout.colour) in.console.colour_mm_s = get(at);
    if (layout.steered) {
      ConsoleSetting& console = in.console;
      for (double* value : {&console.compound_deg, &console.lean_deg, &console.box_across, &console.box_down})
        *value = get(at);
    }
  }
  return {};
}

void read_poses(const std::byte*& from, std::size_t count, const ChunkLayout& layout, Recording& recording) {
  const auto words = table_at(from, count, layout.pose_columns());
  const std::uint64_t* at = words.data();
  for (std::size_t row = 0; row < count; ++row) {
    PoseSample& pose = recording.poses.emplace_back();
    pose.t_s = get(at);
    pose.tip_lps_mm = get_point(at);
    pose.needle_direction = get_point(at);
    pose.probe_origin_lps_mm = get_point(at);
    pose.probe_axial = get_point(at);
    pose.probe_lateral = get_point(at);
    if (layout.moving) pose.rest_tip_lps_mm = get_point(at);
  }
}

void read_forces(const std::byte*& from, std::size_t count, Recording& recording) {
  const auto words = table_at(from, count, kForceColumns);
  const std::uint64_t* at = words.data();
  for (std::size_t row = 0; row < count; ++row) {
    ForceSample& force = recording.forces.emplace_back();
    for (double* value : {&force.t_s, &force.needle_axial_n, &force.needle_lateral_n, &force.probe_n})
      *value = get(at);
  }
}

void read_frames(const std::byte*& from, std::size_t count, const ChunkLayout& layout, Recording& recording) {
  const auto words = table_at(from, count, layout.frame_columns());
  const std::uint64_t* at = words.data();
  for (std::size_t row = 0; row < count; ++row) {
    FrameTruth& frame = recording.frames.emplace_back();
    frame.t_s = get(at);
    frame.needle_length_mm = get(at);
    const std::uint64_t bits = *at++;
    frame.live = (bits & kLive) != 0;
    frame.needle_tip = (bits & kNeedleTip) != 0;
    frame.target = (bits & kTarget) != 0;
    if (layout.near_plane) frame.near_plane = near_plane_of(bits);
    if (!layout.fluoroscope) continue;
    const BeamTruth beam = get_beam(at);
    if ((bits & kBeam) == 0) continue;
    frame.beam = beam;
    frame.beam->arm_moving = (bits & kArmMoving) != 0;
    frame.beam->hand_in_beam = (bits & kHand) != 0;
  }
}

base::Result<void> read_events(const std::byte*& from, std::size_t count, const ChunkLayout& layout,
                               Recording& recording) {
  const auto words = table_at(from, count, layout.event_columns());
  const std::uint64_t* at = words.data();
  for (std::size_t row = 0; row < count; ++row) {
    Event& event = recording.events->emplace_back();
    event.t_s = get(at);
    const std::uint64_t word = *at++;
    event.kind = static_cast<EventKind>(word & 0xffU);
    event.tenths_mm = static_cast<std::uint16_t>(word >> kLengthShift & 0xffffU);
    if (word > 0xff'ffffU || find_event(event.kind) == nullptr) return unknown_event();
    if (layout.pauses) event.wall_s = get(at);
    if (!(event.wall_s >= 0.0 && std::isfinite(event.wall_s)))
      return base::Error{"damaged", "holds a pause without a sound length"};
  }
  return {};
}

void read_endpoint_at_rest(const std::byte*& from, Recording& recording) {
  const auto words = table_at(from, 1, kRestColumns);
  const std::uint64_t* at = words.data();
  recording.endpoint->rest_tip_lps_mm = get_point(at);
}

}  // namespace seldinger::cases
