// What is drawn of the room in one picture: plain data, made anew for each without making meshes or allocating
// (once its list has grown), and tested without GL.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

#include "sim/case/case.h"
#include "sim/case/state.h"
#include "sim/imaging/room/room_model.h"

namespace seldinger::imaging {

enum class RoomPart : std::uint8_t {
  skin,
  cut_end,  // where the CT ends
  drape,
  table,
  floor,
  walls,
  wheal,  // where the skin is numb
  nick,   // and where it is cut
  needle_shaft,
  needle_hub,
  introducer,  // its tube, and its hub
  probe,
  target,
  structure,
  bone,
  planned_path,  // entry → target
  planned_entry,
  scan_plane,
  guide_line,  // where the needle would go on
  tube,        // of the C-arm, with the arc that carries it
  detector
};

// Which light map a thing casts into: that of what seldom moves, or that around the tools, drawn each time.
enum class Casts : std::uint8_t { nothing, still, tools };

struct RoomItem {
  RoomPart part = RoomPart::skin;
  MeshHandle mesh = kNoMesh;
  glm::dmat4 lps_from_mesh{1.0};
  glm::vec4 colour{1.0F};  // linear; alpha < 1: drawn over what is behind, in the list's order
  float roughness = 0.6F, metal = 0.0F;
  glm::vec3 light_under_skin{0.0F};  // share of light that goes round (red, green, blue)
  Casts casts = Casts::nothing;
  bool shadowed = true;    // shadows fall on it
  bool displaced = false;  // moves with the tissue
  bool cut = false;        // by DrawList::cut
  bool both_sides = false;
  bool over_all = false;       // drawn last, hidden by nothing
  double least_half_px = 0.0;  // x and y of the mesh are a radius, drawn at least as many pixels wide
};

// What has dot(normal, place) > distance is cut away of items that are cut.
struct CutPlane {
  glm::dvec3 normal{0.0};
  double distance_mm = 0.0;
};

struct DrawList {
  std::vector<RoomItem> items;  // opaque ones first
  std::optional<CutPlane> cut;
  bool needs_displacement = false;  // something displaced is in the list
};

// The tube through which a core needle goes.
struct RoomIntroducer {
  glm::dvec3 end_lps_mm{0.0}, axis{0.0, 0.0, 1.0};  // unit, hub → end
};

struct RoomOptions {
  // 0: as in reality. 1: the scan plane's outline. 2: also the planned entry, and the line on which the needle
  // would go on. 3: also the target through the skin, and the planned path.
  int help = 0;
  // Half the skin is cut away; target, structures and bone show. For a mentor who looks back, and who plans on the
  // CT; never in an attempt.
  bool mentor = false;
  bool glass = false;                          // with `mentor`: nothing is cut away, the skin can be looked through
  bool needle = true, probe = true;            // what hands hold
  std::span<const glm::dvec3> numb_lps_mm{};   // where an anaesthetic was given, of the skin at rest
  std::span<const glm::dvec3> nicks_lps_mm{};  // and where the skin was nicked
  std::optional<RoomIntroducer> introducer{};
};

// Of a state: the tools where hands hold them. `list` is emptied first.
void make_draw_list(const RoomModel& room, const cases::Case& scene, const cases::State& state,
                    const RoomOptions& options, DrawList& list);

}  // namespace seldinger::imaging
