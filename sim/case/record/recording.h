// A recording: the Inputs of every tick, the resulting poses at 100 Hz, what each picture showed, and a hash per
// tick. Metrics read poses and frames only, so a score never depends on a later step; replay of the inputs by the
// same step version reproduces poses and hashes bit for bit.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/base/result.h"
#include "sim/case/event.h"
#include "sim/case/inputs.h"

namespace seldinger::cases {

struct PoseSample {
  double t_s = 0.0;
  glm::dvec3 tip_lps_mm{0.0};
  glm::dvec3 needle_direction{0.0, 0.0, 1.0};  // unit, hub → tip
  glm::dvec3 probe_origin_lps_mm{0.0};
  glm::dvec3 probe_axial{0.0, 0.0, 1.0};
  glm::dvec3 probe_lateral{1.0, 0.0, 0.0};
  // Where the tissue at the tip lies in a patient at rest, as the CT, lesions and structures do. Nothing: at the
  // tip.
  std::optional<glm::dvec3> rest_tip_lps_mm{};
  const glm::dvec3& tip_at_rest_lps_mm() const noexcept { return rest_tip_lps_mm ? *rest_tip_lps_mm : tip_lps_mm; }
  bool operator==(const PoseSample&) const = default;
};

// How one pulse of a fluoroscope was made.
struct BeamTruth {
  double lao_deg = 0.0, cranial_deg = 0.0;
  double kv = 0.0, ma = 0.0;
  double air_kerma_mgy = 0.0, dap_mgy_cm2 = 0.0;
  double collimated_share = 0.0;  // of the whole field, shut off
  double beam_s = 0.0;            // what the pulse stands for: 1/rate
  bool arm_moving = false, hand_in_beam = false;
  bool operator==(const BeamTruth&) const = default;
};

// Whether tip and target's centre lie within 2 mm and 5 mm of the plane, inside the picture's field: nothing else
// is asked. What others count as seen (Perk Tutor: 5 mm; its documentation: 2 mm).
struct NearPlane {
  bool tip_2_mm = false, target_2_mm = false, tip_5_mm = false, target_5_mm = false;
  bool operator==(const NearPlane&) const = default;
};

// What one picture showed (docs/decisions/0005, 0013).
struct FrameTruth {
  double t_s = 0.0;
  bool live = true;  // not frozen, no last image held
  bool needle_tip = false;
  bool target = false;
  double needle_length_mm = 0.0;
  std::optional<BeamTruth> beam{};        // of a fluoroscope's pulse; none for a held image and other modalities
  std::optional<NearPlane> near_plane{};  // of ultrasound; none for other modalities and before format 3
  bool joint() const noexcept { return needle_tip && target; }
  bool operator==(const FrameTruth&) const = default;
};

// What tissue asked of the motors: a model's force, whatever a device made of it.
struct ForceSample {
  double t_s = 0.0;
  double needle_axial_n = 0.0;    // > 0 resists insertion
  double needle_lateral_n = 0.0;  // across the needle, ≥ 0
  double probe_n = 0.0;           // ≥ 0
  bool operator==(const ForceSample&) const = default;
};

struct Endpoint {
  double t_s = 0.0;
  glm::dvec3 tip_lps_mm{0.0};  // when the trigger fell, before any throw
  glm::dvec3 direction{0.0, 0.0, 1.0};
  std::optional<glm::dvec3> rest_tip_lps_mm{};  // as a pose's
  const glm::dvec3& tip_at_rest_lps_mm() const noexcept { return rest_tip_lps_mm ? *rest_tip_lps_mm : tip_lps_mm; }
  bool operator==(const Endpoint&) const = default;
};

struct Recording {
  std::uint32_t step_version = 0;
  double dt_s = 0.001;
  std::vector<Inputs> inputs;         // one per tick
  std::vector<std::uint32_t> hashes;  // low word of the chained state hash after each tick; same length as inputs
  std::vector<PoseSample> poses;      // 100 Hz
  std::vector<ForceSample> forces;    // 100 Hz, each beside its pose; empty: nothing was to be felt
  std::vector<FrameTruth> frames;     // the picture's rate; a fluoroscope's: each pulse, and when its time is over
  // What was said, asked for and answered, and what became of hands and clock, by rising time; nothing: it was not
  // listened to (a pose file, a recording before format 5), and what is missing is no omission.
  std::optional<std::vector<Event>> events{};
  std::optional<Endpoint> endpoint;
};

// One compressed piece of a recording, as the library stores it.
struct RecordingChunk {
  std::uint32_t sequence = 0;
  std::uint64_t checksum = 0;  // base::hash_bytes of data
  std::vector<std::byte> data;
};

// Chunks hold two seconds each, numbered from 0; the one in which the trigger fell carries the endpoint. Since
// format 2 a chunk in which the fluoroscope was used holds its inputs, exposures and beams too; since format 3
// frames of ultrasound say what was near its plane; since format 4 there are forces, since format 5 events and, of
// a patient who moves, where tips are at rest; since format 6 a chunk in which the console was not as the case has
// it holds how it stood; since format 7 one with a pause holds how long it was; since format 8 one with colour
// Doppler holds its scale; since format 9 one in which the console looked aside or colour's box was moved holds
// how. Formats 1 to 8, without, are read too; so are those whose events, in bits that were 0 then, tell no length.
std::vector<RecordingChunk> chunks_from_recording(const Recording& recording);

constexpr double kChunkSeconds = 2.0;
// The same, as it is recorded: `piece` holds what belongs to this chunk and nothing else.
RecordingChunk chunk_of(const Recording& piece, std::uint32_t sequence);

// Refused: `damaged` (checksum, codec), `incomplete` (a sequence number is missing), `recording_version`.
base::Result<Recording> recording_from_chunks(std::span<const RecordingChunk> chunks);

}  // namespace seldinger::cases
