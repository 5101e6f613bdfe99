#include "app/measure/ultrasound_goals/needle.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numbers>

#include "app/measure/ultrasound_goals/polar_levels.h"
#include "shaders/shared/ultrasound.glsl.h"
#include "sim/imaging/ultrasound/view/fan.h"
#include "sim/imaging/ultrasound/view/view.h"

namespace seldinger::measure {

using imaging::Inserted;
using imaging::NeedlePose;
using imaging::PolarPicture;
using imaging::UltrasoundView;

namespace {

const TissueBlock& water() {
  static const TissueBlock kWater = block_of(volume::TissueClass::fluid);
  return kWater;
}

constexpr float kSeen = 1e-2F;  // ten times what water scatters

// Where the line ends: the tip lies half a beam's width short of where the level falls to half, coming from beyond.
// Between beams the screen interpolates. Null-like (NaN) where nothing ends.
glm::dvec3 seen_tip(const std::vector<Peak>& peaks, const UltrasoundView& view) {
  const imaging::Fan fan = imaging::fan_of(view);
  int b = view.beams - 1;
  while (b >= 0 && peaks[static_cast<std::size_t>(b)].level < kSeen) --b;
  if (b < 0 || b == view.beams - 1) return glm::dvec3(NAN);
  // Up to the first crest.
  int crest = b;
  while (crest > 0 &&
         peaks[static_cast<std::size_t>(crest) - 1].level > 1.02F * peaks[static_cast<std::size_t>(crest)].level)
    --crest;
  const double half = 0.5 * static_cast<double>(peaks[static_cast<std::size_t>(crest)].level);
  int beyond = crest + 1;
  while (beyond < view.beams - 1 && peaks[static_cast<std::size_t>(beyond)].level > half) ++beyond;
  const Peak &near = peaks[static_cast<std::size_t>(beyond) - 1], &far = peaks[static_cast<std::size_t>(beyond)];
  const double share = (near.level - half) / static_cast<double>(near.level - far.level);
  const double depth_mm = near.depth_mm;
  const double half_width_mm = 0.5 * shaders::kUsFwhmPerSigma *
                               imaging::beam_width(view.probe, working_mhz(view), 0.0, depth_mm).lateral_sigma_mm;
  const double beam = beyond - 1 + share - half_width_mm / fan.beam_spacing_mm(depth_mm);
  return imaging::point_of(view, beam, depth_mm);
}

}  // namespace

Inserted needle_at(double x_mm, double depth_mm, double tilt_deg, double out_mm) {
  const double a = tilt_deg * std::numbers::pi / 180.0;
  Inserted inserted;
  NeedlePose needle;
  needle.tip_lps_mm = {x_mm, depth_mm, out_mm};
  needle.direction = {std::cos(a), std::sin(a), 0.0};
  inserted.needle = needle;
  return inserted;
}

void measure_needle_place(const Setting& setting, Readings& readings) {
  UltrasoundView view = setting.view();
  const double pixel_mm = imaging::ScanConverter(view, {}).pixel_mm();
  double worst_axis_px = 0.0, worst_deg = 0.0, worst_tip_mm = 0.0;
  bool seen = true;
  for (const double share : {0.15, 0.4, 0.65})
    for (const double tilt_deg : {0.0, 15.0, 30.0, 45.0, 60.0}) {
      if (setting.quick && (tilt_deg == 15.0 || tilt_deg == 45.0)) continue;
      const Inserted inserted = needle_at(4.0, share * view.depth_mm + 5.0, tilt_deg);
      const NeedlePose& needle = *inserted.needle;
      const PolarPicture picture = setting.picture(water(), view, inserted);
      std::vector<Peak> peaks;
      double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
      for (int b = 0; b < view.beams; ++b) {
        peaks.push_back(peak_of(picture, view, b));
        if (peaks.back().level < kSeen) continue;
        const glm::dvec3 p = imaging::point_of(view, b, peaks.back().depth_mm), from_tip = p - needle.tip_lps_mm;
        const double along = -glm::dot(from_tip, needle.direction);
        if (along < 2.0 || along > 40.0) continue;
        // Of the near side, one radius above the axis.
        const double off_mm = glm::length(from_tip + along * needle.direction) - needle.radius_mm;
        worst_axis_px = farther(worst_axis_px, std::abs(off_mm) / pixel_mm);
        ++n, sx += p.x, sy += p.y, sxx += p.x * p.x, sxy += p.x * p.y;
      }
      const glm::dvec3 tip = seen_tip(peaks, view);
      // Between the tip on the axis and its near side.
      const glm::dvec3 up(needle.direction.y, -needle.direction.x, 0.0), off = tip - needle.tip_lps_mm;
      const double tip_mm = glm::length(off - std::clamp(glm::dot(off, up), 0.0, needle.radius_mm) * up);
      seen = seen && n >= 4 && std::isfinite(tip_mm);
      worst_tip_mm = farther(worst_tip_mm, tip_mm);
      const double slope = (sxy - sx * sy / n) / (sxx - sx * sx / n);
      worst_deg = farther(worst_deg, std::abs(std::atan(slope) * 180.0 / std::numbers::pi - tilt_deg));
    }
  const std::string probe(setting.probe.name);
  readings.push_back({11, "needle's axis, 800 x 700", probe, seen ? worst_axis_px : NAN, "pixels", 1.0, 1.0});
  readings.push_back({11, "needle's angle", probe, seen ? worst_deg : NAN, "degrees", 0.5, 0.5});
  readings.push_back({11, "needle's tip", probe, seen ? worst_tip_mm : NAN, "mm", 0.5, 0.2});
}

double needle_grey(const Setting& setting, double tilt_deg, bool echogenic) {
  UltrasoundView view = setting.view();
  view.depth_mm = 50.0;
  view.beams = 256;
  view.echogenic_needle = echogenic;
  // So long that the middle beams meet the shaft far from the tip.
  const Inserted inserted = needle_at(6.0, 25.0 + 6.0 * std::tan(tilt_deg * std::numbers::pi / 180.0), tilt_deg);
  const PolarPicture picture = setting.picture(water(), view, inserted);
  float level = 0.0F;
  for (int b = 126; b < 130; ++b) level = std::max(level, peak_of(picture, view, b).level);
  return shaders::us_grey(decibels(level), imaging::kWhiteDb, 60.0) / 255.0;
}

void measure_needle_fading(const Setting& setting, Readings& readings) {
  const double plain = needle_grey(setting, 75.0, false) / needle_grey(setting, 0.0, false),
               echogenic = needle_grey(setting, 75.0, true) / needle_grey(setting, 0.0, true);
  const std::string probe(setting.probe.name);
  readings.push_back({12, "grey at 75 over 0 degrees, plain", probe, std::abs(plain - 0.08), "", 0.03, 0.03});
  readings.push_back({12, "grey at 75 over 0 degrees, echogenic", probe, std::abs(echogenic - 0.55), "", 0.1, 0.1});
}

void measure_slice(const Setting& setting, Readings& readings) {
  double worst = 0.0;
  UltrasoundView view = setting.view();
  view.beams = 16;
  for (const double share : {0.15, 0.4, 0.8}) {
    const double depth_mm = share * view.depth_mm;
    const auto level = [&](double out_mm) {
      return peak_of(setting.picture(water(), view, needle_at(30.0, depth_mm, 0.0, out_mm)), view, 8).level;
    };
    const float half = 0.5F * level(0.0);
    const double fwhm_mm = imaging::elevation_fwhm_mm(view.probe, working_mhz(view), depth_mm);
    double low = 0.0, high = 2.0 * fwhm_mm;
    for (int i = 0; i < 16; ++i) (level(0.5 * (low + high)) > half ? low : high) = 0.5 * (low + high);
    worst = farther(worst, 100.0 * std::abs(low / (0.5 * fwhm_mm) - 1.0));
  }
  readings.push_back(
      {13, "where the needle falls to half", std::string(setting.probe.name), worst, "%", 10.0, 3.0});
}

}  // namespace seldinger::measure
