// What tissue takes from the speckle behind it: attenuation (2), contrast of what scatters less (9), enhancement
// (10).
#include <algorithm>
#include <glm/geometric.hpp>

#include "app/measure/ultrasound_goals/goal.h"
#include "app/measure/ultrasound_goals/polar_levels.h"
#include "shaders/shared/ultrasound.glsl.h"
#include "sim/imaging/ultrasound/view/fan.h"
#include "sim/imaging/ultrasound/view/view.h"

namespace seldinger::measure {

using imaging::PolarPicture;
using imaging::UltrasoundView;
using volume::TissueClass;

namespace {

// Slope of the speckle's level in dB over depth, a straight line through rows of frames of different tissue. For
// the reference the same tissue without loss is taken off, so that chance goes with it.
double slope_db_cm(const Setting& setting, const TissueBlock& block, UltrasoundView view, double from_mm,
                   double to_mm) {
  constexpr int kRows = 60;
  const bool paired = setting.quality == Quality::reference;
  const int frames = paired ? 6 : std::max(4, setting.frames(6));
  std::vector<double> level(kRows, 0.0);
  for (int frame = 1; frame <= frames; ++frame) {
    view.seed = static_cast<std::uint64_t>(frame);
    const PolarPicture picture = setting.picture(block, view);
    PolarPicture without;
    if (paired) {
      UltrasoundView lossless = view;
      lossless.attenuation_db_cm_mhz = 0.0;
      without = setting.picture(block, lossless);
    }
    for (int i = 0; i < kRows; ++i) {
      const int low = sample_at(view, from_mm + (to_mm - from_mm) * i / kRows),
                high = sample_at(view, from_mm + (to_mm - from_mm) * (i + 1) / kRows);
      double sum = 0.0;
      for (int k = low; k < high; ++k)
        for (int b = 0; b < view.beams; ++b)
          sum += decibels(std::max(1e-12F, at(picture, b, k))) -
                 (paired ? decibels(std::max(1e-12F, at(without, b, k))) : 0.0);
      level[static_cast<std::size_t>(i)] += sum / (high - low) / view.beams / frames;
    }
  }
  double zz = 0, zl = 0;
  for (int i = 0; i < kRows; ++i) {
    const double z_cm = 0.1 * (to_mm - from_mm) * ((i + 0.5) / kRows - 0.5);
    zz += z_cm * z_cm;
    zl += z_cm * level[static_cast<std::size_t>(i)];
  }
  return -zl / zz;
}

double impedance(TissueClass tissue) {
  return imaging::acoustic_table()[static_cast<std::size_t>(tissue)].impedance_mrayl;
}
double step_loss_db(TissueClass a, TissueClass b) {
  return shaders::us_step_loss_db(shaders::us_reflection(impedance(a), impedance(b)));
}

}  // namespace

void measure_attenuation(const Setting& setting, Readings& readings) {
  struct Case {
    double db_cm_mhz, mhz;
  };
  // 0.1 to 2 dB/cm/MHz and 2 to 10 MHz, each where the probe's depth lets the slope be told to a few tenths of a %.
  static constexpr Case kCurved[] = {{0.5, 2.0}, {0.5, 3.57}, {1.0, 5.0}, {2.0, 3.57}, {0.7, 7.0}, {0.1, 5.0}};
  static constexpr Case kStraight[] = {{0.5, 7.6}, {0.3, 10.0}, {2.0, 7.6}};
  const TissueBlock liver = block_of(TissueClass::liver);
  double worst = 0.0;
  const std::span<const Case> cases =
      setting.probe.radius_mm > 0.0 ? std::span<const Case>(kCurved) : std::span<const Case>(kStraight);
  for (const Case& one : setting.quick ? cases.subspan(1, 2) : cases) {
    UltrasoundView view = setting.view();
    view.frequency_mhz = one.mhz;
    view.attenuation_db_cm_mhz = one.db_cm_mhz;
    const double wanted = 2.0 * one.db_cm_mhz * one.mhz;
    const double to_mm = std::min(0.967 * view.depth_mm, 10.0 * 100.0 / wanted);  // within 100 dB
    const double slope = slope_db_cm(setting, liver, view, view.depth_mm / 30.0, to_mm);
    worst = farther(worst, 100.0 * std::abs(slope / wanted - 1.0));
  }
  readings.push_back({2, "slope of level over depth", std::string(setting.probe.name), worst, "%", 1.0, 0.1});
}

void measure_contrast(const Setting& setting, Readings& readings) {
  const bool curved = setting.probe.radius_mm > 0.0;
  const double depth_mm = curved ? 60.0 : 25.0, radius_mm = curved ? 15.0 : 10.0;
  double worst = 0.0;
  for (const TissueClass tissue :
       {TissueClass::spleen, TissueClass::fat, TissueClass::skin, TissueClass::connective}) {
    const TissueBlock block = tissue_block(
        [=](const glm::dvec3& p) {
          return std::hypot(p.x, p.y - depth_mm) < radius_mm ? tissue : TissueClass::liver;
        },
        curved ? glm::ivec3{70, 110, 40} : glm::ivec3{100, 180, 60}, curved ? 1.0 : 0.5);
    UltrasoundView view = setting.lossless_view();
    view.depth_mm = depth_mm + 15.0;
    const double half_beams = 0.4 * radius_mm / imaging::fan_of(view).beam_spacing_mm(depth_mm);
    const int first = static_cast<int>(0.5 * view.beams - half_beams),
              end = static_cast<int>(0.5 * view.beams + half_beams) + 1;
    double inside = 0.0, outside = 0.0;
    const int frames = setting.frames(curved ? 12 : 6);
    for (int frame = 1; frame <= frames; ++frame) {
      view.seed = static_cast<std::uint64_t>(frame);
      const PolarPicture picture = setting.picture(block, view);
      // Echoes at the cylinder's wall stay out: what is asked is speckle, inside and above.
      inside += mean_square(picture, first, end, sample_at(view, depth_mm - 0.4 * radius_mm),
                            sample_at(view, depth_mm + 0.4 * radius_mm));
      outside += mean_square(picture, first, end, sample_at(view, depth_mm - 2.0 * radius_mm),
                             sample_at(view, depth_mm - 1.2 * radius_mm));
    }
    const double wanted = imaging::acoustic_table()[static_cast<std::size_t>(tissue)].scatter_db -
                          step_loss_db(TissueClass::liver, tissue);
    worst = farther(worst, std::abs(10.0 * std::log10(inside / outside) - wanted));
  }
  readings.push_back({9, "cylinders of -7 to +6 dB", std::string(setting.probe.name), worst, "dB", 1.0, 0.3});
}

void measure_enhancement(const Setting& setting, Readings& readings) {
  // A cyst 20 mm deep in liver of 0.5 dB/cm/MHz.
  const bool curved = setting.probe.radius_mm > 0.0;
  const double top_mm = curved ? 40.0 : 10.0, half_mm = curved ? 20.0 : 9.0;
  const TissueBlock block = tissue_block(
      [=](const glm::dvec3& p) {
        return std::abs(p.x) < half_mm && p.y > top_mm && p.y < top_mm + 20.0 ? TissueClass::fluid
                                                                              : TissueClass::liver;
      },
      curved ? glm::ivec3{150, 120, 30} : glm::ivec3{100, 100, 30}, curved ? 2.0 : 1.0);
  UltrasoundView view = setting.view();
  view.depth_mm = curved ? 100.0 : 50.0;
  if (curved) view.frequency_mhz = 3.5;
  view.attenuation_db_cm_mhz = 0.5;
  const int low = sample_at(view, top_mm + 24.0), high = sample_at(view, curved ? 96.0 : 49.0);
  const imaging::Fan fan = imaging::fan_of(view);
  const double half_beams = 0.5 * half_mm / fan.beam_spacing_mm(top_mm);
  const int first = static_cast<int>(0.5 * view.beams - half_beams),
            end = static_cast<int>(0.5 * view.beams + half_beams) + 1;
  double behind = 0.0, beside = 0.0;
  const int frames = setting.frames(8);
  for (int frame = 1; frame <= frames; ++frame) {
    view.seed = static_cast<std::uint64_t>(frame);
    const PolarPicture picture = setting.picture(block, view);
    behind += level_db(picture, first, end, low, high) / frames;
    beside += 0.5 *
              (level_db(picture, beam_at(view, 4), beam_at(view, 24), low, high) +
               level_db(picture, beam_at(view, 104), beam_at(view, 124), low, high)) /
              frames;
  }
  // Beams at an angle pass more of it.
  double path_cm = 0.0;
  for (int b = first; b < end; ++b) path_cm += 2.0 / fan.direction(b).y / (end - first);
  const double mhz = working_mhz(view);
  const double wanted =
      10.0 * path_cm * (shaders::us_loss_db_per_mm(0.5, 1.0, mhz) - shaders::us_loss_db_per_mm(0.002, 2.0, mhz)) -
      2.0 * step_loss_db(TissueClass::liver, TissueClass::fluid);
  readings.push_back({10, "level behind a cyst of 20 mm", std::string(setting.probe.name),
                      std::abs(behind - beside - wanted), "dB", 0.5, 0.1});
}

}  // namespace seldinger::measure
