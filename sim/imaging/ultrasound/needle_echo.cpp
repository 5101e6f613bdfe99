#include "sim/imaging/ultrasound/needle_echo.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shaders/shared/ultrasound.glsl.h"
#include "sim/base/vectors.h"

namespace seldinger::imaging {
namespace {

constexpr double kAlongRad = 1.55;  // a beam along the shaft meets its tip alone
constexpr double kDegPerRad = 180.0 / std::numbers::pi;

double amplitude(double db) {
  return std::pow(10.0, db / 20.0);
}

double tip_db(const UltrasoundView& view, const NeedlePose& needle, double tilt_deg) noexcept {
  if (view.sight_law == cases::SightLaw::half_slice) return kNeedleTipDb;
  const double slower = view.echogenic_needle ? kEchogenicFadeDbPerDeg / kPlainFadeDbPerDeg : 1.0;
  const double fade_db = (kNeedleMirrorDb - kTipGoneDb) * slower * tilt_deg / kTipGoneDeg;
  const double sideways = std::sin(needle.bevel_turn_rad);
  return std::max(kNeedlePointDb, kNeedleMirrorDb - fade_db - kBevelSideDb * sideways * sideways);
}

}  // namespace

NeedleEcho needle_echo(const UltrasoundView& view, const NeedlePose& needle, double depth_mm,
                       double tilt_rad) noexcept {
  const double size = std::sqrt(needle.radius_mm / kNeedleLevelRadiusMm);
  const double cone_rad = shaders::us_cone_rad(depth_mm, view.probe.aperture_mm, view.probe.f_number);
  const double tilt_deg = tilt_rad * kDegPerRad;
  const double fade = view.echogenic_needle ? kEchogenicFadeDbPerDeg : kPlainFadeDbPerDeg;
  NeedleEcho echo;
  echo.mirror = size * amplitude(kNeedleMirrorDb) * shaders::us_mirror(tilt_rad, cone_rad);
  echo.rough = tilt_rad < kAlongRad ? size * amplitude(kNeedleRoughDb - fade * tilt_deg) : 0.0;
  echo.tip = size * amplitude(tip_db(view, needle, tilt_deg));
  return echo;
}

bool is_usable(const NeedlePose& needle) noexcept {
  return base::is_finite(needle.tip_lps_mm) && base::is_finite(needle.direction) &&
         std::isfinite(needle.length_mm) && needle.length_mm > 0.0 && needle.radius_mm > 0.0;
}

}  // namespace seldinger::imaging
