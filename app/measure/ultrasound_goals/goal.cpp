#include "app/measure/ultrasound_goals/goal.h"

#include <array>
#include <cmath>
#include <limits>

namespace seldinger::measure {
namespace {

constexpr Goal kGoals[] = {
    {1, "scan conversion", true, &measure_scan_conversion},
    {2, "attenuation", true, &measure_attenuation},
    {3, "shadow", true, &measure_shadow},
    {4, "reflection", false, &measure_reflection},
    {5, "angle law", false, &measure_angle_law},
    {6, "speckle statistics", true, &measure_statistics},
    {7, "speckle size", true, &measure_widths},
    {8, "speckle in motion", true, &measure_motion},
    {9, "contrast", false, &measure_contrast},
    {10, "enhancement", false, &measure_enhancement},
    {11, "needle's place", true, &measure_needle_place},
    {12, "needle's fading", false, &measure_needle_fading},
    {13, "slice thickness", false, &measure_slice},
    {14, "logarithm and grey", false, &measure_grey},
    {15, "same bits", false, &measure_bits},
    {16, "beside the scanner by elements", false, &measure_elements},
};

}  // namespace

std::span<const Goal> ultrasound_goals() {
  return kGoals;
}

Setting Setting::of(imaging::UltrasoundMethod method, const imaging::Probe& probe, Quality quality) {
  Setting setting;
  setting.method = method;
  setting.probe = probe;
  setting.quality = quality;
  if (quality == Quality::reference) {
    setting.beams = 512;
    setting.samples = 2048;
    setting.scatterers_per_cell = 24.0;
  }
  setting.paint = [](const imaging::TissueVolume& tissue, const imaging::UltrasoundView& view,
                     const imaging::Inserted& inserted, imaging::PolarPicture& picture) {
    imaging::ultrasound_polar(tissue, view, inserted, {}, picture);
  };
  return setting;
}

imaging::UltrasoundView Setting::view() const {
  imaging::UltrasoundView view;
  view.method = method;
  view.probe = probe;
  view.depth_mm = depth_mm();
  view.beams = beams;
  view.samples = samples;
  view.scatterers_per_cell = scatterers_per_cell;
  return view;
}

imaging::UltrasoundView Setting::lossless_view() const {
  imaging::UltrasoundView lossless = view();
  lossless.attenuation_db_cm_mhz = 0.0;
  return lossless;
}

imaging::PolarPicture Setting::picture(const TissueBlock& block, const imaging::UltrasoundView& view,
                                       const imaging::Inserted& inserted) const {
  imaging::PolarPicture picture;
  paint(block.tissue(), view, inserted, picture);
  return picture;
}

double Reading::share(Quality quality) const noexcept {
  if (off == 0.0) return 0.0;
  const double share = off / tolerance(quality);
  return std::isfinite(share) ? share : std::numeric_limits<double>::infinity();
}

Readings measure_all(const Setting& setting) {
  Readings readings;
  for (const Goal& goal : kGoals) goal.measure(setting, readings);
  return readings;
}

Readings measure_by_setting(const Setting& setting) {
  Readings readings;
  for (const Goal& goal : kGoals)
    if (goal.by_setting) goal.measure(setting, readings);
  return readings;
}

Worst worst_of(std::span<const Reading> readings, Quality quality) {
  Worst worst;
  for (const Reading& reading : readings)
    if (reading.share(quality) >= worst.share)
      worst = {reading.share(quality), std::to_string(reading.goal) + " " + reading.what};
  return worst;
}

}  // namespace seldinger::measure
