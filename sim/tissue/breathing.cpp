#include "sim/tissue/breathing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "sim/base/exact_math.h"
#include "sim/base/hash.h"
#include "sim/base/rng.h"

namespace seldinger::tissue {
namespace {

constexpr double kHoldTurnS = 0.5;  // from breathing to holding and back (design)
constexpr double kCoughRiseS =
    0.06;  // a cough's throw is at its height after this, and is over after eight times it (design)
constexpr double kMostOff = 2.0;  // standard deviations
// A dome has lung beside it: it is where all but this share of the lungs' voxels lie above.
constexpr double kLungBelowDome = 0.3;
constexpr double kPelvisBelowDomeMm = 350.0, kApexAboveDomeMm = 200.0;  // of an adult (design)

double drawn(std::uint64_t seed, std::uint64_t counter) {
  return std::clamp(base::normal_at(seed, counter), -kMostOff, kMostOff);
}

// Of a breath: 1, give or take.
double off(const BreathSettings& settings, std::uint64_t breath, std::uint64_t what) {
  return 1.0 + settings.irregularity * drawn(settings.seed, 2 * breath + what);
}

// Holds draw from a stream of their own, so that breaths stay what they are.
double hold_off(const BreathSettings& settings, std::uint64_t hold) {
  return settings.hold_spread * drawn(base::hash_combine(settings.seed, std::uint64_t{0x686f6c64}), hold);
}

double eased(double t) {
  return t * t * (3.0 - 2.0 * t);
}

double cough(double t_s) {
  const double t = t_s / kCoughRiseS;
  if (!(t > 0.0) || t >= 8.0) return 0.0;
  const double fading = 1.0 - eased(t / 8.0);
  return t * base::exact_exp(1.0 - t) * fading;
}

}  // namespace

double advance(const BreathSettings& settings, double dt_s, const BreathAsks& asks, BreathState& state) noexcept {
  // A cough ends a hold: it must be asked for anew.
  if (asks.cough) {
    state.cough_s = dt_s;
    state.failed = asks.hold;
  } else if (state.cough_s > 0.0) {
    state.cough_s += dt_s;
    if (state.cough_s >= 8.0 * kCoughRiseS) state.cough_s = 0.0;
  }
  if (!asks.hold) state.failed = false;
  state.asked_s = asks.hold && !state.failed ? state.asked_s + dt_s : 0.0;
  if (state.asked_s > settings.hold_delay_s + settings.hold_most_s) {
    state.failed = true;
    state.asked_s = 0.0;
  }
  const double turn = dt_s / kHoldTurnS;
  const bool holding = state.asked_s > settings.hold_delay_s;
  // Whoever holds comes from breathing: a hold that was let go of is over before the next can begin.
  if (holding && state.held == 0.0) state.hold_off = hold_off(settings, state.holds++);
  if (holding) state.hold_off -= settings.hold_drift_per_s * dt_s;
  state.held = std::clamp(state.held + (holding ? turn : -turn), 0.0, 1.0);

  if (state.held < 1.0) {
    state.phase += dt_s / (settings.period_s * off(settings, state.breath, 0));
    if (state.phase >= 1.0) {
      state.phase -= 1.0;
      ++state.breath;
    }
  }
  const double wave = base::exact_sin(std::numbers::pi * state.phase);
  double level = off(settings, state.breath, 1);
  for (int i = 0; i < settings.sharpness; ++i) level *= wave * wave;
  level += eased(state.held) * (settings.hold_level + state.hold_off - level);
  return level - settings.cough_level * cough(state.cough_s);
}

bool holds(const BreathState& state) noexcept {
  return state.held >= 1.0 && state.cough_s == 0.0;
}

glm::dvec3 breath_amount_mm(const BreathSettings& settings, double level) noexcept {
  return (level - settings.ct_level) * settings.amplitude_mm;
}

std::optional<BreathRegion> breath_region(const cases::Case& scene) {
  if (scene.skin.vertices_lps_mm.empty()) return std::nullopt;
  glm::dvec3 low(scene.skin.vertices_lps_mm[0]), high = low;
  for (const glm::vec3& vertex : scene.skin.vertices_lps_mm) {
    low = glm::min(low, glm::dvec3(vertex));
    high = glm::max(high, glm::dvec3(vertex));
  }
  BreathRegion region;
  region.middle_x_mm = 0.5 * (low.x + high.x);
  region.half_width_mm = 0.5 * (high.x - low.x);
  region.back_y_mm = high.y;
  region.depth_mm = high.y - low.y;
  region.dome_z_mm = high.z;
  region.above_mm = kApexAboveDomeMm;
  region.below_mm = kPelvisBelowDomeMm;
  if (!(region.half_width_mm > 0.0) || !(region.depth_mm > 0.0)) return std::nullopt;

  // Lungs by mm of height; a slice of an oblique volume adds to several.
  const volume::Volume& volume = scene.volume;
  if (scene.classes.size() != volume.hu.size()) return region;
  const auto bins = static_cast<std::size_t>(std::max(1.0, std::ceil(high.z - low.z)));
  std::vector<double> lung(bins, 0.0);
  double total = 0.0;
  std::size_t at = 0;
  for (int k = 0; k < volume.size_voxels.z; ++k)
    for (int j = 0; j < volume.size_voxels.y; ++j)
      for (int i = 0; i < volume.size_voxels.x; ++i, ++at) {
        if (scene.classes[at] != volume::TissueClass::lung) continue;
        const double z_mm = (volume.lps_from_voxel * glm::dvec4(i, j, k, 1.0)).z - low.z;
        lung[static_cast<std::size_t>(std::clamp(z_mm, 0.0, static_cast<double>(bins - 1)))] += 1.0;
        total += 1.0;
      }
  if (!(total > 0.0)) return region;
  double below = 0.0;
  std::size_t dome = 0, apex = bins - 1;
  while (dome + 1 < bins && below + lung[dome] <= kLungBelowDome * total) below += lung[dome++];
  while (apex > dome && lung[apex] == 0.0) --apex;
  region.dome_z_mm = low.z + static_cast<double>(dome);
  // A volume that ends within the lungs does not show the apex.
  const bool cut = lung[bins - 1] + lung[bins > 1 ? bins - 2 : 0] > 0.0;
  if (!cut) region.above_mm = std::max(50.0, static_cast<double>(apex - dome));
  return region;
}

}  // namespace seldinger::tissue
