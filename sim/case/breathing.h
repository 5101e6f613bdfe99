// How a patient breathes: plain data of a case and of a state. What it does: sim/tissue/breathing.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "sim/base/names.h"

namespace seldinger::cases {

// What is published of how far breath moves a liver's dome, in one place. mm: to the right, to the front,
// downwards.
namespace breath {
// A quiet breath. Downwards 11.7 (4.8 to 23.3) of liver tumours without a belt (Eccles, IJROBP 79, 2011, abstract),
// liver 10 ± 8 (Davies, Br. J. Radiol. 67, 1994, recalled); to the front 2 to 8, to the right 1 to 3 (Rohlfing,
// Med. Phys. 31, 2004, recalled).
inline constexpr glm::dvec3 kQuietMm{1.0, 5.0, 12.0};
// The deepest that a case has, in quiet breaths: 15 to the front, as de Jong's CT, and 36 downwards: liver 37 ± 8
// in deep breaths (Davies 1994, recalled).
inline constexpr double kDeepest = 3.0;
// From CT breathed out to CT breathed in: liver, to the right 2 (−11 to 11), to the front 15 (9 to 21), downwards
// 16 (6 to 24) (de Jong, IJCARS 2019, abstract). What cases of before call a quiet breath.
inline constexpr glm::dvec3 kBetweenCtMm{2.0, 15.0, 16.0};
// A dome held at the end of breathing out goes up at a constant speed (Holland, Radiology 209, 1998, abstract: mean
// of ten volunteers; breathed in, up to 5.6 mm in 24 s: Khot, Br. J. Radiol. 93, 2020).
inline constexpr double kHoldDriftMmPerS = 0.15;
// Standard deviation of where it is from hold to hold on one day (Dawson, IJROBP 51, 2001, recalled).
inline constexpr double kHoldSpreadMm = 2.5;
}  // namespace breath

// In which breath the CT was taken: where tissue at rest is.
enum class CtBreath { expiration, inspiration };
inline constexpr auto kCtBreathNames =
    base::names<CtBreath>({{CtBreath::expiration, "expiration"}, {CtBreath::inspiration, "inspiration"}});

struct Breathing {
  double period_s = 4.0;
  // From the end of breathing out to that of breathing in, where it is most, mm.
  glm::dvec3 amplitude_mm = breath::kBetweenCtMm;
  double ct_level = 0.0;  // at which tissue is where the CT saw it: 0 breathed out, 1 breathed in
  // n of cos^2n: the more, the longer a breath rests at its end (Lujan, Med. Phys. 26, 1999, recalled: 1 to 3).
  int sharpness = 2;
  double irregularity = 0.1;  // standard deviation of period and of amplitude, as a share (design)
  double hold_delay_s = 1.5;  // from being asked until the patient holds (design)
  double hold_most_s = 15.0;  // then breath fails (design)
  double hold_level = 0.0;    // where it is held: 0 breathed out, 1 breathed in
  // Beside it: standard deviation from hold to hold, and how fast breath goes out while one lasts; shares of a
  // breath.
  double hold_spread = 0.0, hold_drift_per_s = 0.0;
  bool slides = false;       // what lies within the trunk's wall, along it (sim/tissue/cavity_wall.h)
  double cough_level = 0.6;  // how far a cough throws the diaphragm up, as a share of a breath (design)
  std::uint64_t seed = 1;
  bool operator==(const Breathing&) const = default;
};

// What must be kept from tick to tick. A new one: breathed out, about to breathe in.
struct BreathState {
  double phase = 0.0;        // of the breath, 0 to 1; 0 and 1: breathed out
  std::uint64_t breath = 0;  // how many have ended
  double asked_s = 0.0;      // since a hold was asked for; 0: it is not
  bool failed = false;       // the hold was too long; until it is asked for anew
  double held = 0.0;         // 0 breathes, 1 holds
  double cough_s = 0.0;      // since a cough began; 0: none
  std::uint64_t holds = 0;   // how many have begun
  double hold_off = 0.0;     // how far from its level this one is, as a share of a breath
};

}  // namespace seldinger::cases
