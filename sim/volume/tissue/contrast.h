// In which phase of a contrast agent a CT was taken, told from the CT alone.
#pragma once

#include <optional>
#include <vector>

#include "sim/base/names.h"
#include "sim/volume/classes.h"

namespace seldinger::volume {

// Early: blood is full of it and organs are not yet (an arterial phase). Venous: organs are (portal venous,
// nephrographic). Late: it is in the urine and nearly gone from blood.
enum class ContrastPhase { none, early, venous, late };
inline constexpr auto kContrastPhaseNames = base::names<ContrastPhase>({{ContrastPhase::none, "none"},
                                                                        {ContrastPhase::early, "early"},
                                                                        {ContrastPhase::venous, "venous"},
                                                                        {ContrastPhase::late, "late"}});

struct Contrast {
  ContrastPhase phase = ContrastPhase::none;
  // Of blood and organs that are even over 6 mm: 30 ml are as bright as this, and more. Nothing where there are not
  // as many.
  std::optional<int> brightest_hu{};
  // Nothing but the brightest is enhanced, as organs would be: it may lie in the bowel.
  bool may_be_swallowed = false;
  std::optional<int> aorta_hu{};  // as was given: the phase is that of its blood
};

// Classes: as many as voxels (CHECK). By the level of the aorta, where it is known; else by what is brightest,
// which swallowed contrast or a bladder may be.
Contrast contrast_of(const Volume& volume, const std::vector<TissueClass>& classes,
                     std::optional<int> aorta_hu = {});

}  // namespace seldinger::volume
