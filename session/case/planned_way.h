// A straight way from an entry to a target: how long, how steep, and what it meets. What a mentor sees who places
// either, and a trainee who plans; whether a case is worth an attempt is for session/case/case_check to say.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim/case/case.h"

namespace seldinger::session {

// A stretch of the way in something that a needle keeps out of, or is to cross.
struct WayPart {
  std::string what;  // "bone", "gas", or a structure's name
  double from_mm = 0.0, length_mm = 0.0;
  glm::dvec3 place_lps_mm{0.0};  // where it begins
  bool forbidden = false;        // bone, gas, a major or critical structure
};

struct PlannedWay {
  glm::dvec3 entry_lps_mm{0.0}, target_lps_mm{0.0};
  double length_mm = 0.0;
  double skin_angle_deg = 0.0;  // between the way and the skin's normal: 0 is straight in
  double head_deg = 0.0;        // > 0: it runs towards the head, < 0: the feet
  std::vector<WayPart> parts;   // by where they begin
  bool too_long = false;        // for the needle
  // Tissue that must be crossed and is not, for as long as case_check asks.
  std::vector<std::string> not_crossed;

  bool free() const noexcept;
};

// By the limits of assessment::path_limits. Nothing without a planned entry or a target, or where both are one.
std::optional<PlannedWay> planned_way(const cases::Case& scene);
// The same of any entry and any target; nothing where both are one.
std::optional<PlannedWay> way_between(const cases::Case& scene, const glm::dvec3& entry_lps_mm,
                                      const glm::dvec3& target_lps_mm);

}  // namespace seldinger::session
