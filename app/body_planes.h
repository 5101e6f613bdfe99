// The needle's way in the body, on planes of the CT through the target: what a replay draws beside the picture.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/grey_picture.h"
#include "assessment/signals.h"
#include "sim/case/case.h"

namespace seldinger::app {

// Millimetres to the right of and below the plane's upper left corner.
struct PlaneSegment {
  glm::dvec2 from_mm, to_mm;
};

struct PlaneOutline {
  std::string name;  // of a structure
  cases::StructureRule rule{};
  std::vector<PlaneSegment> segments;
};

struct BodyPlane {
  std::string name;                       // Axial, Coronal, Sagittal
  std::string left, right, upper, lower;  // the patient's sides there: "R", "L", "A", "P", "H", "F"
  glm::dvec3 corner_lps_mm, u, v;         // upper left; to the right; down
  double side_mm = 0.0;                   // square
  GreyPicture ct;                         // kPixelsAside in each direction
  std::vector<PlaneSegment> skin;         // where the plane cuts it
  std::vector<PlaneOutline> structures;   // those that it cuts

  glm::dvec2 at(const glm::dvec3& point_lps_mm) const;  // projected onto the plane
};

// Three through the target (or the last tip), all of one side: the way inside, 15 mm before it, target and planned
// entry.
std::vector<BodyPlane> body_planes(const cases::Case& scene, const assessment::Signals& signals);

}  // namespace seldinger::app
