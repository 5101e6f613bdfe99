#include "sim/imaging/ultrasound/needle_echo.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
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

// How much of the needle, as the beam sees it from above, lies along the picture: 1 in its plane, 0 square to it.
double along_picture(const UltrasoundView& view, const glm::dvec3& needle, const glm::dvec3& beam) noexcept {
  const glm::dvec3 elevation = glm::normalize(glm::cross(view.axial, view.lateral));
  const double across = glm::dot(needle, elevation), along = glm::dot(needle, glm::cross(elevation, beam));
  const double both = across * across + along * along;
  return both > 1e-9 ? along * along / both : 1.0;
}

double tip_db(const UltrasoundView& view, const NeedlePose& needle, double tilt_deg, double in_picture) noexcept {
  if (view.sight_law == cases::SightLaw::half_slice) return kNeedleTipDb;
  const double fade = view.echogenic_needle ? kEchogenicFadeDbPerDeg : kPlainFadeDbPerDeg;
  const double across = (kNeedleMirrorDb - kTipGoneDb) / kTipGoneDeg * fade / kPlainFadeDbPerDeg;
  const bool as_its_shaft = view.sight_law >= cases::SightLaw::tilt;
  const double fade_db = tilt_deg * (as_its_shaft ? in_picture * fade + (1.0 - in_picture) * across : across);
  const double sideways = std::sin(needle.bevel_turn_rad);
  return std::max(kNeedlePointDb, kNeedleMirrorDb - fade_db - kBevelSideDb * sideways * sideways);
}

}  // namespace

double needle_sigma_mm(const UltrasoundView& view, double beam_sigma_mm, double line_spacing_mm) noexcept {
  return view.sight_law >= cases::SightLaw::tilt ? std::max(beam_sigma_mm, line_spacing_mm / kSigmasPerLine)
                                                 : beam_sigma_mm;
}

NeedleEcho needle_echo(const UltrasoundView& view, const NeedlePose& needle, double depth_mm,
                       const glm::dvec3& beam) noexcept {
  const glm::dvec3 direction = glm::normalize(needle.direction);
  const double tilt_rad = std::asin(std::min(1.0, std::abs(glm::dot(direction, beam))));  // off its normal
  const double size = std::sqrt(needle.radius_mm / kNeedleLevelRadiusMm);
  const double cone_rad = shaders::us_cone_rad(depth_mm, view.probe.aperture_mm, view.probe.f_number);
  const double tilt_deg = tilt_rad * kDegPerRad;
  const double fade = view.echogenic_needle ? kEchogenicFadeDbPerDeg : kPlainFadeDbPerDeg;
  NeedleEcho echo;
  echo.mirror = size * amplitude(kNeedleMirrorDb) * shaders::us_mirror(tilt_rad, cone_rad);
  echo.rough = tilt_rad < kAlongRad ? size * amplitude(kNeedleRoughDb - fade * tilt_deg) : 0.0;
  echo.tip = size * amplitude(tip_db(view, needle, tilt_deg, along_picture(view, direction, beam)));
  return echo;
}

bool is_usable(const NeedlePose& needle) noexcept {
  return base::is_finite(needle.tip_lps_mm) && base::is_finite(needle.direction) &&
         std::isfinite(needle.length_mm) && needle.length_mm > 0.0 && needle.radius_mm > 0.0;
}

}  // namespace seldinger::imaging
