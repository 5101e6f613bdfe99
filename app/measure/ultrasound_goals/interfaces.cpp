// Echoes of interfaces: by the impedances (4) and by the angle (5). An echo's strength is the energy of its pulse,
// which does not depend on where samples fall, less that of the speckle around it.
#include <algorithm>
#include <glm/geometric.hpp>
#include <numbers>

#include "app/measure/ultrasound_goals/goal.h"
#include "app/measure/ultrasound_goals/polar_levels.h"
#include "shaders/shared/ultrasound.glsl.h"
#include "sim/imaging/ultrasound/line.h"
#include "sim/imaging/ultrasound/view/fan.h"
#include "sim/imaging/ultrasound/view/view.h"

namespace seldinger::measure {

using imaging::PolarPicture;
using imaging::UltrasoundView;
using volume::TissueClass;

namespace {

const imaging::Acoustics& acoustics(TissueClass tissue) {
  return imaging::acoustic_table()[static_cast<std::size_t>(tissue)];
}

// line.h's law, amplitude.
double angle_law(double tilt_rad) {
  return shaders::us_mirror(tilt_rad, imaging::kUsInterfaceConeRad) +
         std::pow(10.0, imaging::kUsInterfaceRoughDb / 20.0) * std::cos(tilt_rad);
}

// ∫envelope² between two depths; the first and last sample count by the share of them inside.
double energy_mm(const PolarPicture& picture, const UltrasoundView& view, int beam, double from_mm, double to_mm) {
  const double step_mm = view.depth_mm / view.samples;
  double sum = 0.0;
  for (int k = std::max(0, sample_at(view, from_mm)); k <= std::min(view.samples - 1, sample_at(view, to_mm));
       ++k) {
    const double inside = std::min(to_mm, (k + 1) * step_mm) - std::max(from_mm, k * step_mm);
    sum += double{at(picture, beam, k)} * at(picture, beam, k) * std::max(0.0, inside);
  }
  return sum;
}

double axial_sigma_mm(const UltrasoundView& view) {
  return imaging::beam_width(view.probe, working_mhz(view), 0.0, 10.0).axial_sigma_mm;
}

// 20·log10 of measured over wanted amplitude.
double reflection_error_db(const Setting& setting, TissueClass above, TissueClass below, int finer) {
  constexpr double kDepthMm = 8.0, kViewMm = 14.0;
  const TissueBlock block =
      tissue_block([=](const glm::dvec3& p) { return p.y < kDepthMm ? above : below; }, {90, 60, 40}, 1.0);
  UltrasoundView view = setting.lossless_view();
  view.depth_mm = kViewMm;
  view.samples = std::max(64, static_cast<int>(setting.samples * kViewMm / setting.depth_mm())) * finer;
  const imaging::Fan fan = imaging::fan_of(view);
  const double sigma_mm = axial_sigma_mm(view), reach_mm = 2.6 * sigma_mm;
  const double unit = std::sqrt(std::numbers::pi) * sigma_mm;  // ∫ of a squared pulse of peak 1
  const double reflection =
      std::abs(shaders::us_reflection(acoustics(above).impedance_mrayl, acoustics(below).impedance_mrayl));
  const double loss_db_mm = acoustics(above).soft
                                ? 0.0
                                : shaders::us_loss_db_per_mm(acoustics(above).attenuation_db_cm_mhz,
                                                             acoustics(above).exponent, working_mhz(view));
  const double peak = std::pow(10.0, (imaging::kUsInterfaceDb) / 20.0) * reflection;
  // Frames until chance is a fifth of the tolerance: |s + e|² varies by 2s²e² + s⁴.
  const double s2 = std::pow(10.0, 0.1 * std::max(acoustics(above).scatter_db, acoustics(below).scatter_db));
  const double relative2 = (2.0 * s2 * peak * peak + s2 * s2) / std::pow(peak, 4.0);
  const double wanted_relative = setting.quality == Quality::reference ? 0.002 : 0.012;
  const double cells = fan.curved ? 12.0 : 70.0;
  const int frames = std::clamp(static_cast<int>(relative2 / (wanted_relative * wanted_relative) / cells), 1,
                                setting.quick                           ? 20
                                : setting.quality == Quality::reference ? 600
                                                                        : 200);
  double measured = 0.0, wanted = 0.0;
  for (int frame = 1; frame <= frames; ++frame) {
    view.seed = static_cast<std::uint64_t>(frame);
    const PolarPicture picture = setting.picture(block, view);
    for (int b = 0; b < view.beams; ++b) {
      const glm::dvec3 start = fan.start_lps_mm(b), direction = fan.direction(b);
      const double tilt_rad = std::acos(std::min(1.0, direction.y)), depth_mm = (kDepthMm - start.y) / direction.y;
      if (tilt_rad > 0.12) continue;
      const double from_mm = depth_mm - reach_mm, to_mm = depth_mm + reach_mm;
      // Speckle of either side, as much of each as the pulse covers.
      const double around = energy_mm(picture, view, b, from_mm - 4.0 * reach_mm, from_mm) +
                            energy_mm(picture, view, b, to_mm, to_mm + 4.0 * reach_mm);
      measured += (energy_mm(picture, view, b, from_mm, to_mm) - 0.25 * around) / unit;
      wanted += std::pow(peak * angle_law(tilt_rad) * std::pow(10.0, -loss_db_mm * depth_mm / 20.0), 2.0);
    }
  }
  return measured > 0.0 ? 10.0 * std::log10(measured / wanted) : NAN;
}

}  // namespace

void measure_reflection(const Setting& setting, Readings& readings) {
  using enum TissueClass;
  static constexpr std::pair<TissueClass, TissueClass> kPairs[] = {
      {fat, muscle},  {fat, liver},    {liver, bone}, {muscle, gas},        {liver, fluid},
      {fluid, liver}, {muscle, metal}, {skin, fat},   {spleen, connective}, {liver, kidney}};
  double worst = 0.0, weakest = 0.0;
  for (const auto& [above, below] : kPairs)
    for (const int finer : {1, 2}) {
      double& off = below == kidney ? weakest : worst;
      const double error = std::abs(reflection_error_db(setting, above, below, finer));
      off = farther(off, error);
    }
  const std::string probe(setting.probe.name);
  readings.push_back({4, "echo of nine interfaces, two step sizes", probe, worst, "dB", 0.5, 0.05});
  readings.push_back({4, "echo of liver on kidney, weak as speckle", probe, weakest, "dB", 0.5, 0.05});
}

void measure_angle_law(const Setting& setting, Readings& readings) {
  double sum = 0.0;
  int count = 0;
  for (const double tilt_deg : {0.0, 10.0, 20.0, 30.0, 45.0, 60.0, 80.0}) {
    const double tilt = tilt_deg * std::numbers::pi / 180.0;
    const glm::dvec3 normal(std::sin(tilt), std::cos(tilt), 0.0), through(0.0, 20.0, 0.0);
    // Nothing scatters on either side.
    const TissueBlock block = tissue_block(
        [&](const glm::dvec3& p) {
          return glm::dot(p - through, normal) < 0.0 ? TissueClass::fluid : TissueClass::gas;
        },
        {100, 140, 20}, 1.0);
    UltrasoundView view = setting.lossless_view();
    view.depth_mm = 100.0;
    const PolarPicture picture = setting.picture(block, view);
    const imaging::Fan fan = imaging::fan_of(view);
    const double sigma_mm = axial_sigma_mm(view);
    const double loss_db_mm = shaders::us_loss_db_per_mm(acoustics(TissueClass::fluid).attenuation_db_cm_mhz,
                                                         acoustics(TissueClass::fluid).exponent, working_mhz(view));
    const double reflection_db = decibels(std::abs(shaders::us_reflection(
        acoustics(TissueClass::fluid).impedance_mrayl, acoustics(TissueClass::gas).impedance_mrayl)));
    for (int b = view.beams / 32; b < view.beams; b += std::max(1, view.beams / 26)) {
      const glm::dvec3 start = fan.start_lps_mm(b), direction = fan.direction(b);
      const double facing = glm::dot(direction, normal), depth_mm = glm::dot(through - start, normal) / facing;
      const glm::dvec3 there = start + depth_mm * direction;
      if (facing < std::cos(1.41) || depth_mm < 4.0 || depth_mm > 70.0 || std::abs(there.x) > 45.0) continue;
      // How strong, not where: seen from its side, a wall of voxels of 1 mm is a staircase.
      const double reach_mm = 4.0 * sigma_mm + 0.1 + 0.6 * std::sqrt(1.0 - facing * facing) / facing;
      const double energy = energy_mm(picture, view, b, depth_mm - reach_mm, depth_mm + reach_mm);
      const double found_db = 10.0 * std::log10(std::max(energy, 1e-30) / (std::sqrt(std::numbers::pi) * sigma_mm));
      const double wanted_db = imaging::kUsInterfaceDb + reflection_db +
                               decibels(angle_law(std::acos(std::min(1.0, facing)))) - loss_db_mm * depth_mm;
      sum += (found_db - wanted_db) * (found_db - wanted_db);
      ++count;
    }
  }
  readings.push_back({5, "echo of a plane at 0 to 80 degrees, RMS", std::string(setting.probe.name),
                      count >= 60 ? std::sqrt(sum / count) : NAN, "dB", 1.0, 0.2});
}

}  // namespace seldinger::measure
