#include "app/measure/rigs/settling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace seldinger::measure {
namespace {

constexpr double kIdealSpeedMmS = 20.0;
constexpr double kStillMm = 0.001;  // of a device whose encoder is continuous (design)
constexpr double kStillN = 0.1;

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

// Sums for the straight line through (x, y), shifted to the first point so that they stay small.
struct Line {
  double n = 0.0, x0 = 0.0, y0 = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  void add(double at_x, double at_y) {
    if (n == 0.0) x0 = at_x, y0 = at_y;
    const double dx = at_x - x0, dy = at_y - y0;
    n += 1.0;
    x += dx, y += dy, xx += dx * dx, xy += dx * dy, yy += dy * dy;
  }
  // Standard deviation of y from the line of least squares.
  double deviation() const {
    const double sxx = xx - x * x / n, sxy = xy - x * y / n, syy = yy - y * y / n;
    return std::sqrt(std::max(0.0, syy - sxy * sxy / sxx) / n);
  }
};

// One count of the encoder, but for rounding.
double still_mm(const haptics::ArmModel& device) {
  return device.encoder_mm > 0.0 ? device.encoder_mm * (1.0 + 1e-9) : kStillMm;
}

}  // namespace

bool Settling::settled(const haptics::ArmModel& device) const noexcept {
  return position_mm <= still_mm(device) && force_n <= kStillN;
}

Settling settle(const Trial& trial, const ForceLaw& law) {
  Settling result;
  const double step_mm = kIdealSpeedMmS * haptics::kTickS;
  double at_mm = trial.from_mm, force_n = law(at_mm), work_mj = 0.0;
  const auto ideal_to = [&](double target_mm) {
    while (at_mm != target_mm) {
      const double next_mm = at_mm + std::clamp(target_mm - at_mm, -step_mm, step_mm);
      work_mj += force_n * (next_mm - at_mm);
      at_mm = next_mm;
      force_n = law(at_mm);
      result.least_work_mj = std::min(result.least_work_mj, work_mj);
    }
  };
  ideal_to(trial.to_mm);
  ideal_to(trial.to_mm - trial.back_mm);

  haptics::HandRig rig(trial.device, trial.hand, at_mm, trial.speed_mm_s, force_n);
  haptics::HandWill will{at_mm, trial.drive_mm_s, trial.push_n};
  Range position, force;
  Line line;
  std::vector<double> way_mm;
  bool finite = true;
  const auto ticks = static_cast<int>(std::lround(trial.seconds / haptics::kTickS));
  const int watched = ticks - static_cast<int>(std::lround(trial.watched_s / haptics::kTickS));
  for (int tick = 0; tick < ticks && finite; ++tick) {
    const double before_n = force_n;
    force_n = law(rig.encoder_mm());
    finite = std::isfinite(force_n) && std::isfinite(rig.at_mm());
    result.most_step_n = std::max(result.most_step_n, std::abs(force_n - before_n));
    rig.hold(force_n, will);
    will.at_mm = at_mm + trial.drive_mm_s * haptics::kTickS * (tick + 1);
    result.least_work_mj = std::min(result.least_work_mj, work_mj + rig.work_mj());
    way_mm.push_back(rig.at_mm());
    if (tick < watched) continue;
    position.add(rig.at_mm());
    force.add(rig.motor_n());
    line.add(tick * haptics::kTickS, rig.motor_n());
  }
  for (std::size_t i = 0; i < way_mm.size(); ++i)
    if (std::abs(way_mm[i] - way_mm.back()) > still_mm(trial.device))
      result.rest_s = haptics::kTickS * static_cast<double>(i + 1);
  result.position_mm = finite ? position.high - position.low : NAN;
  result.force_n = finite ? force.high - force.low : NAN;
  result.unrest_n = finite ? line.deviation() : NAN;
  return result;
}

}  // namespace seldinger::measure
