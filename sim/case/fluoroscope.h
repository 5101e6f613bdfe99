// A fluoroscope as data: what the machine is (part of Case), how it stands and what it has spent (part of State),
// what its user asks (part of Inputs), and what the last exposed frame reported (part of Inputs: imaging computes
// it from the last frame, and it enters the next tick). Where its rays run: c_arm.h.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "sim/case/viewing_angles.h"

namespace seldinger::cases {

// How the machine stands. Tube under the table. At 0°, 0° of a supine patient rays run from posterior to anterior.
// LAO turns the detector to the patient's left, cranial to the head.
struct CArm {
  double lao_deg = 0.0;      // negative: RAO
  double cranial_deg = 0.0;  // negative: caudal
  double sid_mm = 1100.0;
  glm::dvec3 isocentre_lps_mm{0.0};  // moves with the table
  bool operator==(const CArm&) const = default;
};

// Air kerma is told at the interventional reference point, so far from the isocentre towards the tube
// (IEC 60601-2-43).
constexpr double kReferenceBeforeIsocentreMm = 150.0;

// Fixed facts of the machine. Defaults: a typical angiographic C-arm with a 30 × 30 cm flat detector.
struct Fluoroscope {
  double source_isocentre_mm = 785.0;
  double sid_min_mm = 900.0, sid_max_mm = 1200.0;               // source to detector
  double detector_side_mm = 300.0;                              // square
  std::array<double, 3> field_side_mm = {300.0, 200.0, 150.0};  // by magnification 0, 1, 2
  int picture_px = 512;                                         // square, whatever the field
  double angle_max_deg = 100.0, cranial_max_deg = 45.0;
  double arm_speed_deg_s = 25.0, table_speed_mm_s = 100.0, sid_speed_mm_s = 100.0;
  double table_travel_mm = 400.0;  // of the isocentre from its start, along each axis
  double kv_min = 50.0, kv_max = 120.0, ma_min = 2.0, ma_max = 250.0, pulse_ms = 8.0;
  double filter_al_mm = 3.0, filter_cu_mm = 0.1;  // in the beam, beside the tube's own
  CArm start;                                     // how it stands when the case begins
};

// Open share of the field's half width and half height, each 0.05 to 1.
struct Collimator {
  double open_u = 1.0, open_v = 1.0;
  // Share of the whole field that the blades shut off.
  double shut_share() const noexcept { return 1.0 - open_u * open_v; }
  bool operator==(const Collimator&) const = default;
};
constexpr double kCollimatorMin = 0.05;

struct Technique {
  double kv = 70.0, ma = 30.0, pulse_ms = 8.0;
  bool operator==(const Technique&) const = default;
};

// What hands ask in one tick. Speeds are shares −1 … 1 of the machine's own.
struct FluoroscopeInputs {
  bool pedal = false;
  double lao_speed = 0.0, cranial_speed = 0.0, sid_speed = 0.0;
  glm::dvec3 table_speed{0.0};  // of the isocentre in the patient, LPS
  Collimator collimator;
  int magnification = 0;           // 0, 1, 2
  int pulse_rate = 1;              // 0, 1, 2: 3, 7.5, 15 a second
  bool automatic_exposure = true;  // else kv and ma as asked
  double kv = 70.0, ma = 30.0;
  // The hand has let go: the needle stays where it is, held by tissue or a needle holder, and the hand is away from
  // the beam.
  bool hand_away = false;
  bool operator==(const FluoroscopeInputs&) const = default;
};
constexpr std::array<double, 3> kPulseRateHz = {3.0, 7.5, 15.0};

// What imaging found in the last exposed frame. `frame` 0: none yet. It must reach step before the next pulse: a
// frame that is told of after its successor is not added up.
struct ExposureReport {
  std::uint32_t frame = 0;     // of FluoroscopyState::frames when it was exposed
  double air_kerma_mgy = 0.0;  // this frame's, free in air at the interventional reference point (IEC 60601-2-43:
                               // 150 mm from the isocentre towards the source)
  double dap_mgy_cm2 = 0.0;    // this frame's dose–area product
  Technique next;              // what automatic exposure asks for the next frame
  bool hand_in_beam = false;   // during this frame
  bool operator==(const ExposureReport&) const = default;
};

// How the machine stands and what it has spent. One writer: engine/step. Nothing here changes, and nothing of it is
// hashed, in a case of another modality.
//
// A pulse stands for the time to the next: `frame_s` = 1/rate. Fluoroscopy time is the sum of these, and so are the
// other times; the picture is live as long, then the last image is held until the next pulse.
struct FluoroscopyState {
  bool in_use = false;  // since the first tick of a case of this modality
  CArm arm;
  bool arm_moving = false;  // in this tick: angles, distance or table
  bool beam_on = false;     // the pedal is down
  bool frame_due = false;   // a pulse was fired in this tick: imaging exposes this State
  bool live = false;        // the picture is; otherwise the last image is held
  bool hand_away = false;
  std::uint32_t frames = 0;  // pulses so far
  double wait_s = 0.0;       // until the next pulse may come
  int pulse_rate = 1, magnification = 0;
  Collimator collimator;
  Technique technique;         // of the next pulse
  Technique last_technique;    // of the last pulse
  double frame_s = 0.0;        // what the last pulse stands for
  std::uint32_t reported = 0;  // the last frame whose report was taken in
  double fluoroscopy_time_s = 0.0, beam_while_moving_s = 0.0, hand_in_beam_s = 0.0;
  double air_kerma_mgy = 0.0, dap_mgy_cm2 = 0.0;
  double collimated_s = 0.0;  // sum of the share shut off, times what each pulse stands for
  ViewingAngles views;        // of pulses fired at rest
  // Time-weighted share of the field that was shut off; 0 before the first pulse.
  double collimated_share() const noexcept {
    return fluoroscopy_time_s > 0.0 ? collimated_s / fluoroscopy_time_s : 0.0;
  }
};

}  // namespace seldinger::cases
