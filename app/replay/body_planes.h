// The needle's way in the body, on planes of the CT through the target: what a replay draws beside the picture.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/replay/plane_lines.h"
#include "assessment/signals/signals.h"
#include "session/guidance/grey_picture.h"
#include "sim/case/case.h"

namespace seldinger::app {

struct PlaneOutline {
  std::string name;  // of a structure
  cases::StructureRule rule{};
  std::vector<PlaneSegment> segments;
};

struct BodyPlane : PlaneFrame {           // square
  std::string name;                       // Axial, Coronal, Sagittal
  std::string left, right, upper, lower;  // the patient's sides there: "R", "L", "A", "P", "H", "F"
  double side_mm = 0.0;
  session::GreyPicture ct;               // kPixelsAside in each direction
  std::vector<PlaneSegment> skin;        // where the plane cuts it
  std::vector<PlaneOutline> structures;  // those that it cuts
};

// Three through the target, all of one side: target, planned entry and these points. Without a target through the
// last point; there is one of the two.
std::vector<BodyPlane> body_planes(const cases::Case& scene, std::span<const glm::dvec3> points_lps_mm);
// The same through any place, of at least that side.
std::vector<BodyPlane> body_planes_through(const cases::Case& scene, std::span<const glm::dvec3> points_lps_mm,
                                           const glm::dvec3& place_lps_mm, double least_side_mm);
// The points: the way inside, and 15 mm before it.
std::vector<BodyPlane> body_planes(const cases::Case& scene, const assessment::Signals& signals);

}  // namespace seldinger::app
