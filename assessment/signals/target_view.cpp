#include "assessment/signals/target_view.h"

#include <algorithm>
#include <cmath>

#include "assessment/signals/signals.h"
#include "sim/case/lesion_form.h"

namespace seldinger::assessment {
namespace {

// Of water at 50 keV, about the mean of what a fluoroscope's beam of 50 to 120 kV still has behind a body
// (0.2269 cm²/g: Hubbell and Seltzer, NISTIR 5632, 1995).
constexpr double kWaterPerMm = 0.02269;
// 5 σ of 15 mm² of the panel at the 30 nGy that automatic exposure keeps; 3 by older laws of sight
// (sim/imaging/xray/visibility.h).
double least_contrast(cases::SightLaw law) noexcept {
  return law >= cases::SightLaw::scatter ? 0.05 : 0.03;
}

}  // namespace

bool target_cannot_show(const cases::Case& scene) {
  if (scene.picture.modality != cases::Modality::xray || scene.lesions.empty() || scene.volume.hu.empty())
    return false;
  const cases::Lesion& target = scene.lesions.front();
  const auto about_hu =
      target.in_volume() ? std::optional(target.around_hu) : cases::hu_about(scene.volume, target);
  if (!about_hu) return false;
  const double density = std::abs(target.hu - *about_hu) / 1000.0;  // in water's
  return -std::expm1(-kWaterPerMm * 2.0 * target.radius_mm * density) < least_contrast(scene.sight_law);
}

bool no_view_shows_target(const Signals& signals) {
  return signals.setting.target_cannot_show &&
         std::none_of(signals.frames.begin(), signals.frames.end(),
                      [](const cases::FrameTruth& frame) { return frame.live && frame.target; });
}

}  // namespace seldinger::assessment
