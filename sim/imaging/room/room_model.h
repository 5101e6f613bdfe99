// What of a case the room shows and never changes: the patient on the table, the room around, the tools' forms.
// Made once, without GL; a picture's draw list refers to its meshes.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "sim/case/case.h"
#include "sim/imaging/room/room_mesh.h"

namespace seldinger::imaging {

using MeshHandle = std::uint16_t;  // in RoomModel::meshes
constexpr MeshHandle kNoMesh = 0xffff;

// How the patient lies in the room. Unit vectors of LPS, perpendicular: right-handed as across, head, up.
struct RoomFrame {
  glm::dvec3 up{0.0, -1.0, 0.0};          // away from the floor
  glm::dvec3 head{0.0, 0.0, 1.0};         // along the table, towards the patient's head
  glm::dvec3 across{1.0, 0.0, 0.0};       // of a supine patient: to his left
  glm::dvec3 low_mm{0.0}, high_mm{0.0};   // the skin's bounds along across, head, up
  double table_mm = 0.0, floor_mm = 0.0;  // heights along up: of what the patient lies on, of the floor

  glm::dvec3 lps(double across_mm, double head_mm, double up_mm) const noexcept {
    return across * across_mm + head * head_mm + up * up_mm;
  }
  glm::dvec3 middle_lps_mm() const noexcept {
    const glm::dvec3 middle = 0.5 * (low_mm + high_mm);
    return lps(middle.x, middle.y, middle.z);
  }
};
RoomFrame room_frame_of(const cases::Case& scene);

// Where the operator stands along RoomFrame::across, 1 or −1: on the side where the way in is planned, else where
// the target is, else on the right of a patient who lies on his back.
double operator_side(const RoomFrame& frame, const cases::Case& scene) noexcept;

// What is made; what a session never shows is not.
struct RoomWish {
  std::size_t skin_triangles = 20'000;  // at most; the case's own skin has more
  bool mentor = false;                  // structures and bone, for a look inside
  // In place of the scene's: where another thread may change that meanwhile.
  std::optional<cases::Picture> picture{};
};

struct RoomModel {
  RoomFrame frame;
  glm::dvec3 key_light{0.0, -1.0, 0.0};  // unit, towards it: a lamp over the table, on the operator's side
  std::vector<RoomMesh> meshes;
  // In LPS.
  MeshHandle skin = kNoMesh, cut_ends = kNoMesh, drapes = kNoMesh;
  MeshHandle table = kNoMesh, floor = kNoMesh, walls = kNoMesh;
  // The tip at the origin, hub → tip along z. Of the shaft x and y are in radii, z is in mm.
  MeshHandle shaft = kNoMesh, hub = kNoMesh;
  double shaft_radius_mm = 0.36, throw_mm = 0.0;
  // The middle of the face at the origin, x lateral, z axial; none where no probe is used.
  MeshHandle probe = kNoMesh;
  MeshHandle scan_plane = kNoMesh;  // outline of the picture, in the probe's frame
  MeshHandle ball = kNoMesh;        // radius 1
  MeshHandle rod = kNoMesh;         // radius 1 about z from 0 to 1
  // By RoomWish::mentor, LPS: bone; structures in the case's order.
  MeshHandle bone = kNoMesh;
  std::vector<MeshHandle> structures;
  // Under xray (c_arm_forms.h).
  MeshHandle c_arm_tube = kNoMesh, c_arm_detector = kNoMesh;
};

// Without skin the room is empty of a patient; it stands about the volume then.
RoomModel make_room_model(const cases::Case& scene, const RoomWish& wish = {});

}  // namespace seldinger::imaging
