#include "sim/volume/tissue/contrast.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "sim/base/check.h"
#include "sim/volume/tissue/class_steps.h"

namespace seldinger::volume {
namespace phases {  // files of a folder are compiled as one
namespace {

// Levels after injection: Bae, Radiology 2010;256:32, figures 3 to 6. Without contrast no organ but the thyroid, of
// less than 30 ml, reaches 105; a kidney does from the first phase to the last, and to 220 at most; only arteries
// pass that.
constexpr int kEnhancedHu = 105, kLateHu = 135, kEarlyHu = 220;
constexpr int kBloodHu = 75;  // blood without contrast: 30 to 60 (Prokop and Galanski 2003)
constexpr double kEnoughMl = 30.0;
constexpr double kBlockMm = 6.0;
constexpr double kEvenNoise = 1.6, kEvenHu = 8.0;  // as fluid is told
constexpr std::size_t kLevels = 1200;

bool may_enhance(TissueClass tissue) {
  switch (tissue) {
    case TissueClass::soft_tissue:
    case TissueClass::vessel:
    case TissueClass::liver:
    case TissueClass::kidney:
    case TissueClass::spleen:
    case TissueClass::muscle:
      return true;
    default:
      return false;
  }
}

// How many ml of even blocks there are of each HU from 0 on.
class Levels {
 public:
  Levels(const Volume& volume, const std::vector<TissueClass>& classes, double noise_sd_hu)
      : volume_(volume), classes_(classes), most_sd_hu_(std::hypot(kEvenNoise * noise_sd_hu, kEvenHu)) {
    const glm::ivec3 n = volume.size_voxels;
    const glm::ivec3 block =
        glm::min(n, glm::max(glm::ivec3(2), glm::ivec3(glm::round(kBlockMm / volume.spacing_mm))));
    const glm::ivec3 step = glm::max(glm::ivec3(1), block / 2);
    const glm::dvec3 step_mm = glm::dvec3(step) * volume.spacing_mm;
    const double step_ml = step_mm.x * step_mm.y * step_mm.z * 1e-3;
    for (int k = 0; k + block.z <= n.z; k += step.z)
      for (int j = 0; j + block.y <= n.y; j += step.y)
        for (int i = 0; i + block.x <= n.x; i += step.x)
          if (const auto hu = even_level({i, j, k}, block); hu && *hu >= 0.0)
            ml_[std::min(kLevels - 1, static_cast<std::size_t>(*hu))] += step_ml;
  }

  // The highest level from which on there are so many ml.
  std::optional<int> from_which(double ml) const {
    double sum = 0.0;
    for (std::size_t hu = kLevels; hu-- > 0;)
      if ((sum += ml_[hu]) >= ml) return static_cast<int>(hu);
    return std::nullopt;
  }

  double ml(int from_hu, int to_hu) const {
    double sum = 0.0;
    for (int hu = from_hu; hu < to_hu; ++hu) sum += ml_[static_cast<std::size_t>(hu)];
    return sum;
  }

 private:
  std::optional<double> even_level(const glm::ivec3& low, const glm::ivec3& block) const {
    double sum = 0.0, square = 0.0;
    for (int k = low.z; k < low.z + block.z; ++k)
      for (int j = low.y; j < low.y + block.y; ++j)
        for (int i = low.x; i < low.x + block.x; ++i) {
          const std::size_t at = volume_.index(i, j, k);
          if (!may_enhance(classes_[at])) return std::nullopt;
          const double hu = volume_.hu[at];
          sum += hu;
          square += hu * hu;
        }
    const double count = block.x * block.y * block.z, mean = sum / count;
    if (square / count - mean * mean > most_sd_hu_ * most_sd_hu_) return std::nullopt;
    return mean;
  }

  const Volume& volume_;
  const std::vector<TissueClass>& classes_;
  double most_sd_hu_;
  std::array<double, kLevels> ml_{};
};

}  // namespace
}  // namespace phases

Contrast contrast_of(const Volume& volume, const std::vector<TissueClass>& classes, std::optional<int> aorta_hu) {
  using namespace phases;
  CHECK(classes.size() == volume.hu.size());
  Contrast told;
  const Levels levels(volume, classes, noise_sd_hu(volume, classes));
  told.brightest_hu = levels.from_which(kEnoughMl);
  if (aorta_hu && *aorta_hu >= kBloodHu) {
    told.aorta_hu = aorta_hu;
    told.phase = *aorta_hu >= kEarlyHu  ? ContrastPhase::early
                 : *aorta_hu >= kLateHu ? ContrastPhase::venous
                                        : ContrastPhase::late;
    return told;
  }
  if (!told.brightest_hu || *told.brightest_hu < kEnhancedHu) return told;
  if (*told.brightest_hu >= kEarlyHu) {
    told.phase = ContrastPhase::early;
    told.may_be_swallowed = levels.ml(kEnhancedHu, kEarlyHu) < kEnoughMl;
  } else {
    told.phase = *told.brightest_hu >= kLateHu ? ContrastPhase::venous : ContrastPhase::late;
  }
  return told;
}

}  // namespace seldinger::volume
