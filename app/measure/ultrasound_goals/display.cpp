// From polar to the screen: places (1) and greys (14).
#include <algorithm>
#include <glm/geometric.hpp>

#include "app/measure/ultrasound_goals/goal.h"
#include "app/measure/ultrasound_goals/polar_levels.h"

namespace seldinger::measure {

using imaging::PolarPicture;
using imaging::UltrasoundView;

void measure_scan_conversion(const Setting& setting, Readings& readings) {
  const UltrasoundView view = setting.view();
  const imaging::ScanConverter converter(view, {800, 700});
  double worst_mm = 0.0;
  for (int i = 0; i < 25; ++i) {
    const double beam = (10.0 + (i % 5) * 26.9) * view.beams / 128.0,
                 depth_mm = view.depth_mm * (0.08 + 0.2 * (i / 5) + 0.003 * i);
    PolarPicture polar{view.beams, view.samples, {}};
    polar.envelope.assign(static_cast<std::size_t>(view.beams) * static_cast<std::size_t>(view.samples), 0.0F);
    // A blob wide enough for the screen, symmetric in mm, in dB so that grey is linear in its height.
    const glm::dvec3 center = imaging::point_of(view, beam, depth_mm);
    const double radius_mm = view.depth_mm / 40.0;
    for (int b = 0; b < view.beams; ++b)
      for (int k = std::max(0, sample_at(view, depth_mm - 1.1 * radius_mm));
           k < std::min(view.samples, sample_at(view, depth_mm + 1.1 * radius_mm) + 1); ++k) {
        const double off = glm::distance(imaging::point_of(view, b, depth_at(view, k)), center) / radius_mm;
        const double gain_db = imaging::display_gain_db(view, {}, depth_at(view, k));
        polar.envelope[static_cast<std::size_t>(b) * static_cast<std::size_t>(view.samples) +
                       static_cast<std::size_t>(k)] =
            static_cast<float>(std::pow(10.0, (imaging::kWhiteDb - 60.0 * std::min(1.0, off) - gain_db) / 20.0));
      }
    std::vector<unsigned char> grey;
    converter.grey(view, {}, polar, grey);
    double sum = 0, x = 0, z = 0;
    for (int r = 0; r < 700; ++r)
      for (int c = 0; c < 800; ++c) {
        const double value = grey[static_cast<std::size_t>(r) * 800 + static_cast<std::size_t>(c)];
        sum += value;
        x += value * (c - 399.5) * converter.pixel_mm();
        z += value * (converter.top_mm() + (r + 0.5) * converter.pixel_mm());
      }
    worst_mm = farther(worst_mm, sum > 1000.0 ? std::hypot(x / sum - center.x, z / sum - center.y) : NAN);
  }
  const std::string probe(setting.probe.name);
  readings.push_back({1, "centroid of 25 points", probe, worst_mm, "mm", 0.15, 0.05});
  readings.push_back({1, "centroid of 25 points", probe, worst_mm / converter.pixel_mm(), "pixels", 0.5, 0.5});
}

void measure_grey(const Setting& setting, Readings& readings) {
  UltrasoundView view = setting.view();
  view.beams = 601;
  const imaging::ScanConverter converter(view, {601, 600});
  // A tenth of a decibel a beam, 60 in all; a beam is no narrower than a pixel.
  PolarPicture polar{view.beams, view.samples, {}};
  for (int b = 0; b < view.beams; ++b)
    for (int k = 0; k < view.samples; ++k)
      polar.envelope.push_back(static_cast<float>(std::pow(
          10.0,
          (imaging::kWhiteDb - 60.0 + 0.1 * b - imaging::display_gain_db(view, {}, depth_at(view, k))) / 20.0)));
  std::vector<unsigned char> grey;
  converter.grey(view, {}, polar, grey);
  double worst = 0.0;
  int seen = 0;
  for (int r = 0; r < 600; ++r)
    for (int c = 0; c < 601; ++c) {
      const imaging::BeamAndDepth place = imaging::beam_and_depth(
          view, (c - 300) * converter.pixel_mm(), converter.top_mm() + (r + 0.5) * converter.pixel_mm());
      if (!(place.beam >= 0.0 && place.beam <= 600.0 && place.depth_mm >= 1.0 &&
            place.depth_mm < view.depth_mm - 1.0))
        continue;
      ++seen;
      const double shown = grey[static_cast<std::size_t>(r) * 601 + static_cast<std::size_t>(c)];
      worst = farther(worst, std::abs(shown - 255.0 * place.beam / 600.0));
    }
  // A whole number is up to half a level from what it stands for: that much is no error.
  readings.push_back({14, "grey of a ramp of 60 dB, beyond rounding", std::string(setting.probe.name),
                      seen > 10000 ? std::max(0.0, worst - 0.5) : NAN, "levels", 0.5, 0.02});
}

}  // namespace seldinger::measure
