// How a patient breathes: plain data of a case and of a state. What it does: sim/tissue/breathing.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace seldinger::cases {

struct Breathing {
  double period_s = 4.0;
  // From the end of breathing out to that of breathing in, where it is most: liver, to the right 2 (−11 to 11), to
  // the front 15 (9 to 21), downwards 16 mm (6 to 24) (de Jong, IJCARS 2019, abstract; CT of breathing out and in).
  glm::dvec3 amplitude_mm{2.0, 15.0, 16.0};
  // n of cos^2n: the more, the longer a breath rests at its end (Lujan, Med. Phys. 26, 1999, recalled: 1 to 3).
  int sharpness = 2;
  double irregularity = 0.1;  // standard deviation of period and of amplitude, as a share (design)
  double hold_delay_s = 1.5;  // from being asked until the patient holds (design)
  double hold_most_s = 15.0;  // then breath fails (design)
  double hold_level = 0.0;    // where it is held: 0 breathed out, 1 breathed in
  double cough_level = 0.6;   // how far a cough throws the diaphragm up, as a share of a breath (design)
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
};

}  // namespace seldinger::cases
