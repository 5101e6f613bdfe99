#include "sim/volume/tissue/tissue_told.h"

#include <algorithm>
#include <cmath>

namespace seldinger::volume {

TissueTold tell_tissue(const Volume& volume, const std::vector<TissueClass>& classes, bool labelled,
                       std::optional<int> aorta_hu) {
  constexpr double kCoarseMm = 4.0;  // a rib of 7 mm fills less than two voxels
  TissueTold told;
  told.contrast = contrast_of(volume, classes, aorta_hu);
  const auto count = count_classes(classes);
  const auto voxels = [&](TissueClass tissue) {
    return static_cast<double>(count[static_cast<std::size_t>(tissue)]);
  };
  const double body = static_cast<double>(classes.size()) - voxels(TissueClass::air);
  for (std::size_t at = 0; at < count.size() && body > 0.0; ++at)
    if (at != static_cast<std::size_t>(TissueClass::air)) told.share[at] = static_cast<double>(count[at]) / body;

  constexpr int kAboveBloodHu = 100;  // more than noise and the mixing of contrast
  if (told.contrast.phase != ContrastPhase::late && told.contrast.aorta_hu &&
      told.contrast.brightest_hu.value_or(0) > *told.contrast.aorta_hu + kAboveBloodHu)
    told.doubts.emplace_back("what is brighter than the aorta's blood may be contrast in the bowel or in urine");
  if (told.contrast.may_be_swallowed)
    told.doubts.emplace_back("what is bright may be contrast in the bowel: no organ is enhanced");
  if (!labelled && told.contrast.phase != ContrastPhase::none && voxels(TissueClass::vessel) > 0.0)
    told.doubts.emplace_back("a stone or a calcified plaque deep in a CT with contrast is told as vessel");
  if (voxels(TissueClass::metal) > 0.0)
    told.doubts.emplace_back("metal streaks what lies beside it, whose classes are guesses");
  const double longest_mm = std::max({volume.spacing_mm.x, volume.spacing_mm.y, volume.spacing_mm.z});
  if (longest_mm >= kCoarseMm)
    told.doubts.emplace_back("voxels are " + std::to_string(std::lround(longest_mm)) +
                             " mm long: thin bones and vessels fill parts of them");
  return told;
}

}  // namespace seldinger::volume
