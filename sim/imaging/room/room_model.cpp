#include "sim/imaging/room/room_model.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <vector>

#include "sim/imaging/room/c_arm_forms.h"
#include "sim/imaging/room/field_surface.h"
#include "sim/imaging/room/patient_forms.h"
#include "sim/imaging/room/scan_border.h"
#include "sim/imaging/room/tool_forms.h"

namespace seldinger::imaging {
namespace {

constexpr double kTableHeightMm = 850.0;  // a usual working height
constexpr double kTableHalfWidthMm = 260.0, kMattressMm = 50.0, kTopMm = 35.0;
constexpr double kBeyondBodyMm = 350.0;  // what of the table is seen beyond the patient's ends
constexpr double kWallMm = 2600.0, kCeilingMm = 1900.0;

constexpr double kBoneSpacingMm = 3.0;
constexpr float kBoneHu = 220.0F;

const RoomColour kMattress(0.09F, 0.12F, 0.16F), kSteel(0.62F, 0.63F, 0.65F);

// A box given by the room's axes.
void put_box(const RoomFrame& frame, const glm::dvec3& low_mm, const glm::dvec3& high_mm, double bevel_mm,
             const RoomColour& paint, RoomMesh& mesh) {
  const glm::dmat4 lps_from_room(glm::dvec4(frame.across, 0.0), glm::dvec4(frame.head, 0.0),
                                 glm::dvec4(frame.up, 0.0), glm::dvec4(0.0, 0.0, 0.0, 1.0));
  mesh.append(box(low_mm, high_mm, bevel_mm, paint), lps_from_room);
}

RoomMesh table_of(const RoomFrame& f) {
  const double middle = 0.5 * (f.low_mm.x + f.high_mm.x);
  const double half = std::max(kTableHalfWidthMm, 0.5 * (f.high_mm.x - f.low_mm.x) + 40.0);
  const double foot = f.low_mm.y - kBeyondBodyMm, head = f.high_mm.y + kBeyondBodyMm;
  RoomMesh mesh;
  put_box(f, {middle - half, foot, f.table_mm - kMattressMm}, {middle + half, head, f.table_mm}, 14.0, kMattress,
          mesh);
  put_box(f, {middle - half - 15.0, foot - 15.0, f.table_mm - kMattressMm - kTopMm},
          {middle + half + 15.0, head + 15.0, f.table_mm - kMattressMm}, 8.0, kSteel, mesh);
  // It stands at the foot end: under the patient is room for a tube.
  put_box(f, {middle - 170.0, foot + 20.0, f.floor_mm},
          {middle + 170.0, foot + 320.0, f.table_mm - kMattressMm - kTopMm}, 20.0, kSteel, mesh);
  return mesh;
}

void put_face(const RoomFrame& f, const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v,
              RoomMesh& mesh) {
  const glm::dvec3 normal = glm::normalize(glm::cross(u, v));
  constexpr int n = 8;  // so that light varies over it
  const auto lps = [&](const glm::dvec3& p) { return f.lps(p.x, p.y, p.z); };
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      mesh.add(lps(corner + u * (static_cast<double>(i) / n) + v * (static_cast<double>(j) / n)), lps(normal));
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = base + j * (n + 1) + i;
      mesh.triangles.push_back({a, a + 1, a + n + 1});
      mesh.triangles.push_back({a + 1, a + n + 2, a + n + 1});
    }
}

glm::dvec3 room_middle(const RoomFrame& f) {
  return 0.5 * (f.low_mm + f.high_mm);
}

RoomMesh floor_of(const RoomFrame& f) {
  const glm::dvec3 m = room_middle(f);
  RoomMesh mesh;
  put_face(f, {m.x - kWallMm, m.y - kWallMm, f.floor_mm}, {2.0 * kWallMm, 0.0, 0.0}, {0.0, 2.0 * kWallMm, 0.0},
           mesh);
  return mesh;
}

RoomMesh walls_of(const RoomFrame& f) {
  const glm::dvec3 m = room_middle(f);
  const double w = kWallMm, low = f.floor_mm, rise = f.table_mm + kCeilingMm - f.floor_mm;
  const glm::dvec3 x(2.0 * w, 0.0, 0.0), y(0.0, 2.0 * w, 0.0), z(0.0, 0.0, rise);
  RoomMesh mesh;
  put_face(f, {m.x - w, m.y - w, low}, y, z, mesh);
  put_face(f, {m.x + w, m.y - w, low}, z, y, mesh);
  put_face(f, {m.x - w, m.y - w, low}, z, x, mesh);
  put_face(f, {m.x - w, m.y + w, low}, x, z, mesh);
  put_face(f, {m.x - w, m.y - w, low + rise}, y, x, mesh);
  return mesh;
}

// Of the patient alone: a couch or a cushion can be as dense.
RoomMesh bone_of(const cases::Case& scene) {
  Field field = hu_field(scene.volume, kBoneSpacingMm);
  std::uint32_t near = 0;
  std::size_t at = 0;
  for (int k = 0; k < field.size.z; ++k)
    for (int j = 0; j < field.size.y; ++j)
      for (int i = 0; i < field.size.x; ++i, ++at) {
        if (!(field.values[at] > kBoneHu) || scene.skin_index.empty()) continue;
        const glm::dvec3 place(field.lps_from_node * glm::dvec4(i, j, k, 1.0));
        const cases::Closest skin = scene.skin_index.closest(place, near);
        near = skin.triangle;
        if (skin.distance_mm > 0.0) field.values[at] = static_cast<float>(volume::kAirHu);
      }
  return field_surface(field, kBoneHu);
}

RoomMesh scan_plane_of(const cases::Picture& picture) {
  constexpr int kPieces = 24;
  const std::vector<glm::dvec3> border = scan_border(picture, {}, kPieces);
  // Pieces by themselves: a swept tube would flatten at sharp corners.
  RoomMesh mesh;
  for (std::size_t i = 0; i + 1 < border.size(); ++i)
    mesh.append(swept(std::span(border).subspan(i, 2), 0.5, 6), glm::dmat4(1.0));
  return mesh;
}

}  // namespace

RoomFrame room_frame_of(const cases::Case& scene) {
  RoomFrame f;
  f.up = cases::upwards(scene.position);
  f.across = glm::cross(f.head, f.up);
  f.low_mm = glm::dvec3(std::numeric_limits<double>::max());
  f.high_mm = -f.low_mm;
  const auto take = [&](const glm::dvec3& p) {
    const glm::dvec3 at(glm::dot(p, f.across), glm::dot(p, f.head), glm::dot(p, f.up));
    f.low_mm = glm::min(f.low_mm, at);
    f.high_mm = glm::max(f.high_mm, at);
  };
  for (const glm::vec3& vertex : scene.skin.vertices_lps_mm) take(glm::dvec3(vertex));
  if (scene.skin.vertices_lps_mm.empty())
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 share(corner & 1, (corner >> 1) & 1, corner >> 2);
      take(glm::dvec3(scene.volume.lps_from_voxel * glm::dvec4(share * glm::dvec3(scene.volume.size_voxels), 1.0)));
    }
  f.table_mm = f.low_mm.z;
  f.floor_mm = f.table_mm - kTableHeightMm;
  return f;
}

double operator_side(const RoomFrame& frame, const cases::Case& scene) noexcept {
  constexpr double kMiddleMm = 20.0;
  glm::dvec3 site = frame.middle_lps_mm();
  if (scene.planned_entry_lps_mm)
    site = *scene.planned_entry_lps_mm;
  else if (!scene.lesions.empty())
    site = scene.lesions[0].center_lps_mm;
  return glm::dot(site - frame.middle_lps_mm(), frame.across) > kMiddleMm ? 1.0 : -1.0;
}

RoomModel make_room_model(const cases::Case& scene, const RoomWish& wish) {
  RoomModel room;
  const cases::Picture& picture = wish.picture ? *wish.picture : scene.picture;
  room.frame = room_frame_of(scene);
  // From the head, so that shadows fall beside the tools and not behind them; lower where a detector hangs over the
  // patient, so that its shadow falls beside them too.
  const double side = operator_side(room.frame, scene);
  const double low = picture.modality == cases::Modality::xray ? 1.75 : 1.0;
  room.key_light = glm::normalize(room.frame.up + low * (0.45 * room.frame.head + 0.25 * side * room.frame.across));
  const auto add = [&](RoomMesh mesh) {
    if (mesh.triangles.empty()) return kNoMesh;
    room.meshes.push_back(std::move(mesh));
    return static_cast<MeshHandle>(room.meshes.size() - 1);
  };
  PatientForms patient = patient_forms(scene, room.frame, wish.skin_triangles);
  room.skin = add(std::move(patient.skin));
  room.cut_ends = add(std::move(patient.cut_ends));
  room.drapes = add(std::move(patient.drapes));
  room.table = add(table_of(room.frame));
  room.floor = add(floor_of(room.frame));
  room.walls = add(walls_of(room.frame));
  const cases::Instrument& needle = scene.instrument;
  room.shaft_radius_mm = needle.radius_mm;
  room.throw_mm = needle.kind == cases::InstrumentKind::core ? needle.throw_mm : 0.0;
  room.shaft = add(shaft_form(needle));
  room.hub = add(hub_form(needle));
  if (picture.modality != cases::Modality::xray) {
    const Probe* probe = probe_named(picture.probe);
    room.probe = add(probe_form(probe != nullptr ? *probe : kC52v));
    room.scan_plane = add(scan_plane_of(picture));
  } else {
    room.c_arm_tube = add(c_arm_tube_form(scene.fluoroscope));
    room.c_arm_detector = add(c_arm_detector_form(scene.fluoroscope));
  }
  room.ball = add(unit_sphere(12));
  room.rod = add(turned(
      std::vector<TurnedPart>{{{0.0, 0.0}, {1.0, 0.0}}, {{1.0, 0.0}, {1.0, 1.0}}, {{1.0, 1.0}, {0.0, 1.0}}}, 10));
  if (wish.mentor) {
    room.bone = add(bone_of(scene));
    for (const cases::Structure& structure : scene.structures)
      room.structures.push_back(add(form_of(structure.shape)));
  }
  return room;
}

}  // namespace seldinger::imaging
