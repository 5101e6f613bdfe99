#include "sim/imaging/ultrasound/thesis.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "shaders/shared/ultrasound.glsl.h"
#include "sim/imaging/ultrasound/needle_echo.h"
#include "sim/imaging/ultrasound/view/fan.h"
#include "sim/volume/volume.h"

namespace seldinger::imaging {
namespace {

class ThesisRecipe {
 public:
  ThesisRecipe(const volume::Volume& volume, const UltrasoundView& view, const Inserted& inserted,
               const PictureMotion* motion)
      : volume_(volume),
        voxel_from_lps_(volume::voxel_from_lps(volume)),
        view_(view),
        fan_(fan_of(view)),
        inserted_(inserted),
        motion_(motion) {}

  void paint(int beam, float* envelope) {
    const glm::dvec3 start = fan_.start_lps_mm(beam), direction = fan_.direction(beam);
    const BeamPath path = path_of(fan_, motion_, beam);
    grey_.resize(static_cast<std::size_t>(view_.samples));
    shadow_.resize(grey_.size());
    double left = 1.0;
    for (std::size_t k = 0; k < grey_.size(); ++k) {
      bool needle = false;
      const double hu = hu_at(start + depth_mm(k) * direction, path.at(depth_mm(k)), needle);
      if (hu >= kThesisBoneHu && !needle) left = std::min(left, kThesisBoneShadow);
      if (hu <= kThesisGasHu) left = std::min(left, kThesisGasShadow);
      shadow_[k] = left;  // from the threshold on
      if (needle) left = std::min(left, kThesisNeedleShadow);
      grey_[k] = std::clamp((hu - kThesisBlackHu) / (kThesisWhiteHu - kThesisBlackHu), 0.0, 1.0);
    }
    const auto step = static_cast<std::size_t>(std::max(1.0, std::round(kThesisEdgeStepMm / fan_.sample_mm)));
    for (std::size_t k = 0; k < grey_.size(); ++k) {
      const double before = grey_[k >= step ? k - step : 0], after = grey_[std::min(k + step, grey_.size() - 1)];
      const double edge = 0.5 * std::abs(after - before);
      const double lit = grey_[k] + (edge > kThesisEdgeFrom ? edge : 0.0);
      const double shown = std::clamp(lit * shadow_[k] * noise_at(path.at(depth_mm(k))), 0.0, 1.0);
      envelope[k] = static_cast<float>(std::pow(10.0, (kWhiteDb - 60.0 + 60.0 * shown) / 20.0));
    }
  }

 private:
  double depth_mm(std::size_t k) const { return (static_cast<double>(k) + 0.5) * fan_.sample_mm; }
  // The needle is where it is, everything else where it was at rest.
  double hu_at(const glm::dvec3& p, const glm::dvec3& rest, bool& needle) const {
    if (inserted_.needle && is_usable(*inserted_.needle)) {
      const NeedlePose& n = *inserted_.needle;
      const glm::dvec3 off = p - n.tip_lps_mm;
      const double along = -glm::dot(off, n.direction);
      const double apart = glm::length(off + along * n.direction);
      needle = along >= 0.0 && along <= n.length_mm && apart <= std::max(n.radius_mm, 0.5 * fan_.sample_mm);
      if (needle) return n.hu;
    }
    for (const cases::Lesion& lesion : inserted_.lesions)
      if (!lesion.in_volume() && glm::length(rest - lesion.center_lps_mm) <= lesion.radius_mm) return lesion.hu;
    return volume::sample_trilinear(volume_, glm::dvec3(voxel_from_lps_ * glm::dvec4(rest, 1.0))).value_or(-1024.0);
  }
  double noise_at(const glm::dvec3& p) const {
    const glm::dvec3 cell = glm::floor(p / kThesisNoiseMm);
    const std::uint32_t bits = shaders::us_lattice_bits(
        shaders::us_lattice_seed(static_cast<std::uint32_t>(view_.seed), static_cast<int>(cell.x),
                                 static_cast<int>(cell.y), static_cast<int>(cell.z)));
    return kThesisNoiseLeast + (1.0 - kThesisNoiseLeast) * (bits >> 8) * 0x1.0p-24;
  }

  const volume::Volume& volume_;
  glm::dmat4 voxel_from_lps_;
  const UltrasoundView& view_;
  Fan fan_;
  const Inserted& inserted_;
  const PictureMotion* motion_;
  std::vector<double> grey_, shadow_;
};

}  // namespace

void thesis_polar(const TissueVolume& tissue, const UltrasoundView& view, const Inserted& inserted,
                  const PictureMotion* motion, PolarPicture& picture) {
  ThesisRecipe recipe(*tissue.volume, view, inserted, motion);
  for (int beam = 0; beam < view.beams; ++beam)
    recipe.paint(beam,
                 picture.envelope.data() + static_cast<std::size_t>(beam) * static_cast<std::size_t>(view.samples));
}

}  // namespace seldinger::imaging
