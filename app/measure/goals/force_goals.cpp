#include "app/measure/goals/force_goals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "app/measure/rigs/surface_trials.h"
#include "app/measure/rigs/volume_trials.h"
#include "sim/haptics/arm_model.h"
#include "sim/haptics/needle/insertion.h"

namespace seldinger::measure {
namespace {

using volume::TissueClass;

constexpr double kThesisSpeedMmS = 500.0 / 60.0;
constexpr double kEncoderMm = 0.055;  // the coarsest of the devices
// Behind a rupture and its fall.
constexpr double kBehindMm = 2.0, kBehindS = 0.06;

using Samples = std::vector<haptics::InsertionSample>;

Samples driven(TissueClass tissue, double speed_mm_s, double depth_mm, double hold_s, bool retract,
               bool relaxation) {
  haptics::NeedleSettings settings;
  settings.relaxation = relaxation;
  return haptics::insert({haptics::needle_tissue(tissue), speed_mm_s, depth_mm, hold_s, retract}, settings);
}

double line_n(TissueClass tissue, double depth_mm) {
  return haptics::needle_tissue(tissue).slope_n_mm * depth_mm + haptics::needle_tissue(tissue).intercept_n;
}

double plateau_off_percent(TissueClass tissue) {
  double worst = 0.0;
  for (const double speed : {1.0, kThesisSpeedMmS, 30.0, 100.0})
    for (const double depth : {20.0, 60.0}) {
      const double force_n = driven(tissue, speed, depth, 0.0, false, false).back().force.axial_n;
      worst = std::max(worst, 100.0 * std::abs(force_n / line_n(tissue, depth) - 1.0));
    }
  return worst;
}

double rmse_to_line_n(TissueClass tissue) {
  double rupture_mm = std::numeric_limits<double>::infinity(), sum = 0.0;
  int n = 0;
  for (const haptics::InsertionSample& sample : driven(tissue, kThesisSpeedMmS, 80.0, 0.0, false, false)) {
    if (sample.force.ruptured) rupture_mm = sample.depth_mm;
    if (!(sample.depth_mm > rupture_mm + kBehindMm + kBehindS * kThesisSpeedMmS)) continue;
    const double off_n = sample.force.axial_n - line_n(tissue, sample.depth_mm);
    sum += off_n * off_n;
    ++n;
  }
  return n > 100 ? std::sqrt(sum / n) : NAN;
}

// By how much the moving needle's force falls or rises over two seconds at rest, the most of it.
double changes_percent(TissueClass tissue, bool relaxation) {
  double most = 0.0;
  for (const double speed : {1.0, kThesisSpeedMmS, 100.0}) {
    const Samples samples = driven(tissue, speed, 50.0, 2.0, false, relaxation);
    const std::size_t first = samples.size() - 2001;
    for (std::size_t i = first; i < samples.size(); ++i)
      most = std::max(most, 100.0 * std::abs(samples[i].force.axial_n / samples[first].force.axial_n - 1.0));
  }
  return most;
}

double retraction_off_n(TissueClass tissue) {
  double worst = NAN;
  bool back = false;
  for (const haptics::InsertionSample& sample : driven(tissue, kThesisSpeedMmS, 80.0, 0.0, true, false)) {
    back = back || sample.depth_mm == 80.0;
    if (!back || sample.depth_mm > 60.0 || sample.depth_mm < 1.0) continue;
    const double friction_n = haptics::needle_tissue(tissue).slope_n_mm * sample.depth_mm;
    worst = std::fmax(worst, std::abs(sample.force.axial_n + friction_n));
  }
  return worst;
}

double slow_sd_n(TissueClass tissue) {
  const haptics::NeedleLaw law{haptics::NeedleSettings{}};
  const haptics::NeedleLayer layer{0.0, haptics::needle_tissue(tissue)};
  haptics::NeedleTrack track;
  double sum = 0.0;
  int n = 0;
  for (int tick = 0; tick < 80000; ++tick) {
    const double depth_mm = 0.5 * haptics::kTickS * tick;
    const double told_mm = std::floor(depth_mm / kEncoderMm) * kEncoderMm;
    const double off_n = law.advance({&layer, 1}, told_mm, track).axial_n - line_n(tissue, depth_mm);
    if (depth_mm < 20.0) continue;
    sum += off_n * off_n;
    ++n;
  }
  return std::sqrt(sum / n);
}

double most_step_n(TissueClass tissue) {
  double most = 0.0;
  for (const double speed : {1.0, kThesisSpeedMmS, 50.0, 100.0, 200.0}) {
    const Samples samples = driven(tissue, speed, 70.0, 0.1, true, false);
    for (std::size_t i = 1; i < samples.size(); ++i) {
      const double step_n = std::abs(samples[i].force.axial_n - samples[i - 1].force.axial_n);
      if (!(step_n <= most)) most = step_n;
    }
  }
  return most;
}

}  // namespace

std::vector<ForceReading> force_readings() {
  std::vector<ForceReading> readings;
  for (const TissueClass tissue : {TissueClass::kidney, TissueClass::liver}) {
    const char* where = volume::about(tissue).name;
    readings.push_back({"plateau off its line, 1 to 100 mm/s", where, plateau_off_percent(tissue), "%", 3.0});
    readings.push_back({"RMSE to the published line, 500 mm/min", where, rmse_to_line_n(tissue), "N", 0.065});
    readings.push_back({"change at rest, no relaxation", where, changes_percent(tissue, false), "%", 5.0});
    readings.push_back({"lost in 2 s at rest, with relaxation", where, changes_percent(tissue, true), "%", 40.0});
    readings.push_back({"retraction off friction alone", where, retraction_off_n(tissue), "N", 0.005});
    readings.push_back({"0.5 mm/s through 55 um counts, sd", where, slow_sd_n(tissue), "N", 0.03});
    readings.push_back({"largest step of a tick, to 200 mm/s", where, most_step_n(tissue), "N", 0.15});
  }
  return readings;
}

std::vector<ForceReading> proxy_readings(int ticks) {
  const cases::MeshIndex mesh(bumpy_sphere(448, 224));
  double snags = 0.0, through = 0.0;
  for (const double radius_mm : {0.0, 1.0})
    for (const double friction : {0.0, 0.3}) {
      const haptics::SurfaceSettings settings{
          .radius_mm = radius_mm, .static_friction = friction, .dynamic_friction = friction};
      const Glide gliding = glide(mesh, settings, ticks, 1);
      const Crossings crossings = sweep(mesh, settings, ticks / 10, 2);
      snags += gliding.snags;
      through += gliding.inside + crossings.inside + crossings.untouched;
    }
  double off_deg = 0.0, step_n = 0.0;
  for (const Solid shape : {Solid::ball, Solid::cylinder, Solid::plane}) {
    const SolidInCt solid{.shape = shape};
    const Slide run = slide(solid, ct_of(solid, 3), {}, 4000, 1);
    if (!(run.direction_rms_deg <= off_deg)) off_deg = run.direction_rms_deg;
    if (!(run.most_step_n <= step_n)) step_n = run.most_step_n;
  }
  return {{"ticks that snag", "mesh", snags, "", 0.0},
          {"ticks inside, sweeps not felt", "mesh", through, "", 0.0},
          {"direction, 30 HU noise, rms", "CT", off_deg, "deg", 3.5},
          {"largest step of a tick, 30 HU noise", "CT", step_n, "N", 0.03}};
}

std::vector<ForceReading> stability_readings(const StabilitySurvey& survey) {
  std::vector<ForceReading> readings;
  for (const haptics::ArmModel& device : haptics::arm_models()) {
    double restless = 0.0, margin = std::numeric_limits<double>::infinity();
    bool seen = false;
    for (const RestRow& row : survey.rest) {
      if (std::string_view(row.device.name) != device.name) continue;
      seen = true;
      restless += row.holds() ? 0.0 : 1.0;
    }
    for (const MarginRow& row : survey.margins)
      if (std::string_view(row.device.name) == device.name) margin = std::min(margin, row.rests_at);
    readings.push_back({"trials that do not come to rest", device.name, seen ? restless : NAN, "", 0.0});
    readings.push_back({"still rests when so much stiffer", device.name, seen ? margin : NAN, "times", 1.4, true});
  }
  return readings;
}

}  // namespace seldinger::measure
