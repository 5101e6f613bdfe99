// Lumens that a needle's tip can lie in: the case's structures that hold fluid or blood, and its cysts and
// abscesses, as voxels of the CT. What runs out of them, how fast they are rinsed, and in which order contrast
// fills them.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/case/case.h"
#include "sim/case/needle_flow.h"

namespace seldinger::tissue {

// By a structure's class and name ("calyx": urine; "portal_vein": venous blood); none: it holds neither fluid nor
// blood. A vessel that is no vein is taken for an artery, as in veins.h.
cases::LumenContent content_of(volume::TissueClass tissue, std::string_view name);

// What drives it out through a needle. Source, row by row, in lumens.cpp.
struct ContentLaw {
  double pressure_pa;     // above what is around the hub
  double viscosity_pa_s;  // at body temperature
};
const ContentLaw& law_of(cases::LumenContent content) noexcept;

// What hangs together of one content is one lumen: calyx, collecting system, renal pelvis of one kidney. Vessels
// that meet are each their own, since blood takes contrast along.
struct Lumen {
  cases::LumenContent content = cases::LumenContent::none;
  std::vector<std::uint32_t> voxels;  // of the volume, ascending
  double volume_ml = 0.0;
  double inflow_ml_s = 0.0;  // that rinses it
};

class Lumens {
 public:
  explicit Lumens(const cases::Case& scene);

  std::span<const Lumen> all() const noexcept { return lumens_; }
  const Lumen* find(std::int32_t number) const noexcept {  // nullptr: −1, or no such lumen
    return number >= 0 && static_cast<std::size_t>(number) < lumens_.size()
               ? &lumens_[static_cast<std::size_t>(number)]
               : nullptr;
  }
  double voxel_ml() const noexcept { return voxel_ml_; }
  // Of the voxel around a place of the patient at rest; −1: none. Allocates nothing.
  std::int32_t at(const glm::dvec3& rest_lps_mm) const noexcept;

  // Its voxels as contrast reaches them that comes out at a place: by the way inside the lumen.
  std::vector<std::uint32_t> filling_order(const Lumen& lumen, const glm::dvec3& rest_lps_mm) const;

 private:
  std::vector<Lumen> lumens_;
  glm::ivec3 size_voxels_{0};
  glm::dvec3 spacing_mm_{1.0};
  glm::dmat4 lps_from_voxel_{1.0}, voxel_from_lps_{1.0};
  double voxel_ml_ = 0.0;
};

}  // namespace seldinger::tissue
