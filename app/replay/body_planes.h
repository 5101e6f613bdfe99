// The needle's way in the body, on planes of the CT through the target: what a replay draws beside the picture.
#pragma once

#include <optional>
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

// Three through the target (or the last tip), all of one side: the way inside, 15 mm before it, target and planned
// entry.
std::vector<BodyPlane> body_planes(const cases::Case& scene, const assessment::Signals& signals);

}  // namespace seldinger::app
