#include "sim/imaging/room/draw_list.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace seldinger::imaging {
namespace {

const glm::vec4 kSkin(0.56F, 0.32F, 0.23F, 1.0F), kDrape(0.06F, 0.21F, 0.26F, 1.0F);
const glm::vec4 kFloor(0.17F, 0.19F, 0.21F, 1.0F), kWalls(0.40F, 0.44F, 0.45F, 1.0F);

glm::dmat4 pose(const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& z, const glm::dvec3& origin) {
  return glm::dmat4(glm::dvec4(x, 0.0), glm::dvec4(y, 0.0), glm::dvec4(z, 0.0), glm::dvec4(origin, 1.0));
}

}  // namespace

void make_draw_list(const RoomScene& room, const cases::Case& scene, const cases::State& state,
                    const RoomOptions& options, DrawList& list) {
  list.items.clear();
  list.cut.reset();
  list.needs_displacement = false;
  const auto add = [&](const RoomItem& item) {
    if (item.mesh == kNoMesh) return;
    list.items.push_back(item);
    list.needs_displacement = list.needs_displacement || item.displaced;
  };
  const bool moves = scene.yields || scene.breathing.has_value();

  RoomItem skin;
  skin.part = RoomPart::skin;
  skin.mesh = room.skin;
  skin.colour = kSkin;
  skin.roughness = 0.52F;
  skin.light_under_skin = {0.35F, 0.16F, 0.10F};
  skin.casts = Casts::still;
  skin.displaced = moves;
  skin.cut = skin.both_sides = options.mentor;
  add(skin);
  RoomItem ends = skin;
  ends.part = RoomPart::cut_end;
  ends.mesh = room.cut_ends;
  ends.colour = kDrape;
  ends.roughness = 0.9F;
  ends.light_under_skin = glm::vec3(0.0F);
  add(ends);

  // Hands hold them: pose of State. A thrown core needle has gone on, its handle has not.
  const cases::NeedleState& needle = state.needle;
  const glm::dvec3 z = needle.direction;
  const glm::dvec3 aside = std::abs(glm::dot(z, room.frame.up)) < 0.99 ? room.frame.up : room.frame.head;
  const glm::dvec3 x = glm::normalize(glm::cross(z, aside)), y = glm::cross(z, x);
  RoomItem shaft;
  shaft.part = RoomPart::needle_shaft;
  shaft.mesh = room.shaft;
  shaft.lps_from_mesh = pose(room.shaft_radius_mm * x, room.shaft_radius_mm * y, z, needle.tip_lps_mm);
  shaft.roughness = 0.28F;
  shaft.metal = 0.9F;
  shaft.casts = Casts::tools;
  shaft.least_half_px = 0.75;
  add(shaft);
  RoomItem hub;
  hub.part = RoomPart::needle_hub;
  hub.mesh = room.hub;
  hub.lps_from_mesh = pose(x, y, z, needle.tip_lps_mm - z * (state.fire.fired ? room.throw_mm : 0.0));
  hub.roughness = 0.4F;
  hub.casts = Casts::tools;
  add(hub);
  RoomItem probe;
  probe.part = RoomPart::probe;
  probe.mesh = room.probe;
  probe.lps_from_mesh = pose(state.probe.lateral, glm::cross(state.probe.axial, state.probe.lateral),
                             state.probe.axial, state.probe.origin_lps_mm);
  probe.roughness = 0.45F;
  probe.casts = Casts::tools;
  add(probe);

  RoomItem table;
  table.part = RoomPart::table;
  table.mesh = room.table;
  table.roughness = 0.7F;
  table.casts = Casts::still;
  add(table);
  RoomItem floor;
  floor.part = RoomPart::floor;
  floor.mesh = room.floor;
  floor.colour = kFloor;
  floor.roughness = 0.6F;
  add(floor);
  RoomItem walls;
  walls.part = RoomPart::walls;
  walls.mesh = room.walls;
  walls.colour = kWalls;
  walls.roughness = 0.95F;
  walls.shadowed = false;
  add(walls);
}

}  // namespace seldinger::imaging
