// Organs that a needle can push along and turn as a whole: liver, kidneys and spleen, as the scene's classes have
// them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "sim/case/case.h"
#include "sim/tissue/displacement.h"

namespace seldinger::tissue {

struct LooseOrgan {
  volume::TissueClass tissue;
  glm::dvec3 middle_lps_mm{0.0};
  double radius_mm = 0.0;  // of the ball of its volume
};

// Of each class one, of kidneys those right and left of the skin's middle; what is smaller than a child's kidney is
// none. One pass over the classes, of which there is one per voxel or none.
std::vector<LooseOrgan> loose_organs(const cases::Case& scene);

// The nearest of the class that the needle presses on; nothing where it presses on none.
std::optional<PushedOrgan> pushed(std::span<const LooseOrgan> organs, const NeedleDrag& needle) noexcept;

}  // namespace seldinger::tissue
