// How blood flows in the vessels whose axis and direction are known, which colour Doppler shows: along the axis, by
// a parabola across, in arteries with the heart's beat, which their walls follow (docs/decisions/0085).
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/case/needle_flow.h"
#include "sim/case/structure.h"
#include "sim/tissue/displacement.h"

namespace seldinger::tissue {

constexpr double kBeatS = 60.0 / 70.0;  // of a heart at rest

// By what a vessel's name says ("carotid") and whether it is a vein's (content_of).
struct FlowLaw {
  std::string_view word;
  cases::LumenContent content;
  glm::dvec3 towards_lps;   // the way along its axis that blood takes
  double systole_mm_s;      // in the middle, at its highest
  double diastole_mm_s;     // and at the beat's end; of a vein both are one
  double back_share = 0.0;  // of systole's, that runs back after it
};
// Rows with their sources in blood_flow.cpp. nullptr: not known.
const FlowLaw* flow_law_of(volume::TissueClass tissue, std::string_view name) noexcept;

// In the vessel's middle, along its axis, at a time; at 0 a beat begins.
double middle_speed_mm_s(const FlowLaw& law, double t_s) noexcept;

// How much wider an artery is than when a beat begins, as a share of its diameter; 0 of a vein.
double pulse_share(const FlowLaw& law, double t_s) noexcept;

class BloodFlow {
 public:
  BloodFlow() = default;
  // Drawn tubes of the class vessel that a law knows.
  explicit BloodFlow(std::span<const cases::Structure> structures);

  // Of blood at a place of the patient at rest; none outside of its vessels. What was drawn last lies over what was
  // drawn before.
  glm::dvec3 velocity_mm_s(const glm::dvec3& rest_lps_mm, double t_s) const noexcept;

  // With what the beat adds to a displacement about a place: each artery near it, and what lies on that, by its
  // straight piece that is nearest. The same where there is none.
  Displacement with_pulse(const Displacement& displacement, const glm::dvec3& about_lps_mm,
                          double t_s) const noexcept;
  bool pulsates() const noexcept;  // it has an artery

  bool empty() const noexcept { return vessels_.empty(); }
  std::vector<std::string> names() const;                            // of vessels that show colour
  std::span<const std::string> unknown() const { return unknown_; }  // and of those that do not

 private:
  struct Vessel {
    std::string name;
    const FlowLaw* law = nullptr;
    std::vector<glm::dvec3> points_lps_mm;  // as blood flows
    double radius_mm = 0.0;
    cases::Bounds box;
  };
  std::vector<Vessel> vessels_;
  std::vector<std::string> unknown_;
};

}  // namespace seldinger::tissue
