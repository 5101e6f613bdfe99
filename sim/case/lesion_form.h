// A lesion as a mentor asks for it, and what becomes of it: a sphere of one HU is drawn by the pictures themselves;
// every other is painted into the scene's volume, voxel by voxel, as CT would have averaged it. Metrics ask the
// shape in either case.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "sim/base/names.h"
#include "sim/case/case.h"
#include "sim/volume/volume.h"

namespace seldinger::cases {

enum class LesionOutline { sphere, ellipsoid, irregular };
inline constexpr auto kLesionOutlineNames = base::names<LesionOutline>({{LesionOutline::sphere, "sphere"},
                                                                        {LesionOutline::ellipsoid, "ellipsoid"},
                                                                        {LesionOutline::irregular, "irregular"}});

struct LesionForm {
  LesionKind kind = LesionKind::by_hu;
  LesionOutline outline = LesionOutline::sphere;
  glm::dvec3 center_lps_mm{0.0};
  glm::dvec3 radii_mm{0.0};  // an ellipsoid's, along LPS; of the others all three are the (mean) radius
  double roughness = 0.0;    // irregular: standard deviation of the radius as a share of it, 0 to kMostRoughness
  std::uint64_t seed = 1;    // irregular: which one
  double hu = 0.0;
  bool adds = false;     // hu is added to the tissue there
  double edge_mm = 0.0;  // from all to nothing across the surface
};
constexpr double kMostRoughness = 0.3;

// The radius of an irregular lesion in a direction (unit): the mean one times 1 + a sum of waves over the sphere of
// directions, drawn from the seed, never below a fifth of the mean.
double irregular_radius_mm(const LesionForm& form, const glm::dvec3& direction);

// An irregular one becomes voxels of 1/24 of its radius, at least 0.25 mm; its distance is that of these.
Shape shape_of(const LesionForm& form);

// Not yet in the volume: hu of one that adds is only the addition.
Lesion lesion_of(const LesionForm& form);

// Whether pictures draw it themselves.
inline bool is_plain(const LesionForm& form) noexcept {
  return form.outline == LesionOutline::sphere && !form.adds && form.edge_mm == 0.0;
}

// Mean of what lies about a drawn target, 2 mm from its surface; nothing where that is outside the volume. What it
// is drawn over tells nothing: a calyx that the volume shows is drawn over itself.
std::optional<double> hu_about(const volume::Volume& volume, const Lesion& drawn);

}  // namespace seldinger::cases
