// The room as a scene file asks for it, and its picture.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim/base/result.h"
#include "sim/case/patient_position.h"
#include "sim/imaging/room/room_renderer.h"

namespace seldinger::app {

struct Scene;

struct HeldProbe {
  std::string name = "C5-2v";
  glm::dvec3 origin_lps_mm{0.0}, axial{0.0, 0.0, 1.0}, lateral{1.0, 0.0, 0.0};
  double press_mm = 0.0;  // how far it dents the skin
};

// view: {"kind": "room", …}
struct RoomSceneView {
  imaging::RoomView from = imaging::RoomView::operator_side;
  glm::dvec2 orbit_deg{0.0};  // from there to the right, up
  double zoom = 1.0;          // distance to what is looked at, times this
  int width_px = 800, height_px = 700;
  bool stereo = false, mentor = false;
  int help = 0;
  std::optional<bool> fine;                        // nothing: as this GL is
  std::optional<cases::PatientPosition> position;  // nothing: the case's, else supine
  std::optional<HeldProbe> probe;
  std::optional<glm::dvec3> nick_lps_mm;  // where the skin was nicked
  std::optional<cases::CArm> arm;         // a room with a C-arm
};

struct ColourPicture {
  std::vector<unsigned char> rgb;  // row-major
  int width_px = 0, height_px = 0;
  std::string renderer;  // GL's name of what drew it
  std::size_t triangles = 0;
};

// Refused as volume_of, and where a case's assets are damaged. Throws base::Failure("gl") without GL 4.3.
base::Result<ColourPicture> paint_room(const Scene& scene, const std::string& library);

}  // namespace seldinger::app
