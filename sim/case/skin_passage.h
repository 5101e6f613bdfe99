// Whether a tip is inside the body, followed from pose to pose: only the skin lets it in or out. Caps at the
// volume's ends cannot be punctured, and lung or gas is body (docs/clinical.md). Used by step() and, on recorded
// poses, by metrics.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "sim/case/form/mesh_index.h"

namespace seldinger::cases {

// Far from the skin the tip cannot cross it and nobody needs its depth to the micrometre: more than kFarMm away,
// the distance is asked for again only after kStaleMm of way. That bounds the depth's error; near the skin it is
// exact.
constexpr double kFarMm = 5.0, kStaleMm = 0.25;

struct SkinPassage {
  glm::dvec3 tip_lps_mm{0.0};     // the last pose
  double depth_mm = 0.0;          // below the skin; negative outside; within kStaleMm beyond kFarMm, else exact
  glm::dvec3 asked_lps_mm{0.0};   // where depth_mm was found
  std::uint32_t triangle = 0;     // nearest, the next query's hint
  bool geometric_inside = false;  // inside the closed mesh, caps included
  bool in_body = false;           // came through skin
  glm::dvec3 entry_lps_mm{0.0};   // where it last came in; valid while in_body
};

// The first pose: what starts inside the mesh is in the body, with the skin behind the shaft as its entry.
SkinPassage start_passage(const MeshIndex& skin, const glm::dvec3& tip_lps_mm,
                          const glm::dvec3& direction) noexcept;

// The next pose. Allocation-free. With an empty mesh nothing is ever inside.
void advance_passage(const MeshIndex& skin, const glm::dvec3& tip_lps_mm, SkinPassage& passage) noexcept;

}  // namespace seldinger::cases
