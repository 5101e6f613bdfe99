// A fluoroscope as data: what the machine is (part of Case), how it stands and what it has spent (part of State),
// what its user asks (part of Inputs), and what the last exposed frame reported (part of Inputs: imaging computes
// it from the last frame, and it enters the next tick).
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

namespace seldinger::cases {

// Fixed facts of the machine. Defaults: a typical angiographic C-arm with a 30 × 30 cm flat detector.
struct Fluoroscope {
  double source_isocentre_mm = 785.0;
  double sid_min_mm = 900.0, sid_max_mm = 1200.0;               // source to detector
  double detector_side_mm = 300.0;                              // square
  std::array<double, 3> field_side_mm = {300.0, 200.0, 150.0};  // by magnification 0, 1, 2
  int picture_px = 512;                                         // square, whatever the field
  double angle_max_deg = 100.0, cranial_max_deg = 45.0;
  double arm_speed_deg_s = 25.0, table_speed_mm_s = 100.0, sid_speed_mm_s = 100.0;
  double kv_min = 50.0, kv_max = 120.0, ma_max = 250.0, pulse_ms = 8.0;
  double filter_al_mm = 3.0, filter_cu_mm = 0.1;  // in the beam, beside the tube's own
};

// Tube under the table. At 0°, 0° of a supine patient rays run from posterior to anterior. LAO turns the detector
// to the patient's left, cranial to the head.
struct CArm {
  double lao_deg = 0.0;      // negative: RAO
  double cranial_deg = 0.0;  // negative: caudal
  double sid_mm = 1100.0;
  glm::dvec3 isocentre_lps_mm{0.0};  // moves with the table
};

// Open share of the field's half width and half height, each 0.05 to 1.
struct Collimator {
  double open_u = 1.0, open_v = 1.0;
};

struct Technique {
  double kv = 70.0, ma = 30.0, pulse_ms = 8.0;
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
};
constexpr std::array<double, 3> kPulseRateHz = {3.0, 7.5, 15.0};

// What imaging found in the last exposed frame. `frame` 0: none yet.
struct ExposureReport {
  std::uint32_t frame = 0;     // of FluoroscopyState::frames when it was exposed
  double air_kerma_mgy = 0.0;  // this frame's, free in air at the interventional reference point (IEC 60601-2-43:
                               // 150 mm from the isocentre towards the source)
  double dap_mgy_cm2 = 0.0;    // this frame's dose–area product
  Technique next;              // what automatic exposure asks for the next frame
  bool hand_in_beam = false;   // during this frame
};

}  // namespace seldinger::cases
