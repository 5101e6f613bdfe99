// Veins that give way under a probe. Which they are is told by the case's structures; how far each has closed, by
// the pressure that the probe adds where it passes.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim/case/case.h"
#include "sim/tissue/displacement.h"

namespace seldinger::tissue {

struct CompressibleVein {
  std::string name;
  cases::Tube tube;
};

// Whether a name is that of a vein: it says vein or vena.
bool says_vein(const std::string& name);

// A drawn tube of the class vessel whose name says vein or vena. Arteries keep their shape: their blood's pressure
// is many times what a probe adds. At most kMostVeins, the first ones.
std::vector<CompressibleVein> compressible_veins(const cases::Case& scene);

// mm of vein that one press may close, its ends included (design).
constexpr double kClosedLengthMm = 70.0;
// Of the blood in it above what is around it, N/mm²: 1 cm of water, as in the neck of who sits half up (design).
constexpr double kVeinBloodNMm2 = 1e-4;

// The straight piece of it next to the press, and what is left of its area; nothing where it stays open. Beside a
// bend the piece goes straight on. Allocates nothing.
std::optional<SqueezedVein> squeezed(const CompressibleVein& vein, const SkinPress& press,
                                     double shear_n_mm2) noexcept;

}  // namespace seldinger::tissue
