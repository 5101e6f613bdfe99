#include "sim/imaging/ultrasound/mirror.h"

#include <algorithm>
#include <cmath>

#include "shaders/shared/ultrasound_line.glsl.h"
#include "shaders/shared/ultrasound_mirror.glsl.h"
#include "sim/base/rows.h"
#include "sim/imaging/ultrasound/view/view.h"

namespace seldinger::imaging {
namespace {

using shaders::UsMirror;
using volume::TissueClass;

// The surface is laid through so many beams on either side, while it goes on without a jump, and through so many at
// least: the steps of voxels are evened out.
constexpr int kBesideBeams = 8, kLeastBeams = 7;
constexpr double kMostJumpMm = 4.0;

bool is_mirror(const AirMet& met) {
  return met.tissue == TissueClass::lung && met.depth_mm >= kLeastMirrorMm;
}

struct Point {
  double x_mm, z_mm;
};
Point point_on(const Fan& fan, int beam, double depth_mm) {
  const double across = fan.first_beam + beam * fan.beam_step;
  if (!fan.curved) return {across, depth_mm};
  const double from_center_mm = fan.radius_mm + depth_mm;
  return {from_center_mm * std::sin(across), from_center_mm * std::cos(across) - fan.radius_mm};
}

// The straight line nearest to the points: their middle, and the normal to the way along which they spread most.
glm::dvec4 line_through(std::span<const Point> points) {
  double x = 0.0, z = 0.0, xx = 0.0, xz = 0.0, zz = 0.0;
  const auto count = static_cast<double>(points.size());
  for (const Point& p : points) x += p.x_mm / count, z += p.z_mm / count;
  for (const Point& p : points) {
    xx += (p.x_mm - x) * (p.x_mm - x);
    xz += (p.x_mm - x) * (p.z_mm - z);
    zz += (p.z_mm - z) * (p.z_mm - z);
  }
  const double along = 0.5 * std::atan2(2.0 * xz, xx - zz);
  return {x, z, -std::sin(along), std::cos(along)};
}

}  // namespace

std::vector<UsMirror> mirrors_of(const UltrasoundView& view, std::span<const AirMet> met) {
  const Fan fan = fan_of(view);
  if (std::none_of(met.begin(), met.end(), is_mirror)) return {};
  const auto depth_of = [&](int b) {
    const AirMet& here = met[static_cast<std::size_t>(b)];
    return here.tissue == TissueClass::gas ? kNoAirMm : here.shown_mm;
  };
  const auto goes_on = [&](int from, int to) { return std::abs(depth_of(from) - depth_of(to)) < kMostJumpMm; };
  std::vector<UsMirror> mirrors;
  std::vector<Point> points;
  for (int b = 0; b < view.beams; ++b) {
    UsMirror mirror{};
    mirror.met.x = static_cast<float>(depth_of(b));
    if (is_mirror(met[static_cast<std::size_t>(b)])) {
      int first = b, last = b;
      while (first > std::max(0, b - kBesideBeams) && goes_on(first, first - 1)) --first;
      while (last < std::min(view.beams - 1, b + kBesideBeams) && goes_on(last, last + 1)) ++last;
      points.clear();
      for (int i = first; i <= last; ++i) points.push_back(point_on(fan, i, depth_of(i)));
      const double lung = acoustic_table()[static_cast<std::size_t>(TissueClass::lung)].impedance_mrayl;
      const double reflection = shaders::us_reflection(met[static_cast<std::size_t>(b)].mrayl, lung);
      if (last - first + 1 >= kLeastBeams) {
        mirror.plane = glm::vec4(line_through(points));
        mirror.met.y = static_cast<float>(shaders::us_mirrored_share(reflection));
      }
    }
    mirrors.push_back(mirror);
  }
  return mirrors;
}

shaders::UsMirrorParameters mirror_parameters(const UltrasoundView& view) {
  shaders::UsMirrorParameters p{};
  const Fan fan = fan_of(view);
  p.beams = view.beams;
  p.samples = view.samples;
  p.curved = fan.curved ? 1 : 0;
  p.radius_mm = static_cast<float>(fan.radius_mm);
  p.first_beam = static_cast<float>(fan.first_beam);
  p.beam_step = static_cast<float>(fan.beam_step);
  p.sample_mm = static_cast<float>(fan.sample_mm);
  p.loss_db_mm = static_cast<float>(shaders::us_loss_db_per_mm(kAssumedAttenuationDbCmMhz, 1.0, working_mhz(view)));
  return p;
}

void add_mirrored(const UltrasoundView& view, std::span<const UsMirror> mirrors, PolarPicture& picture) {
  if (mirrors.empty() || view.beams < 2 || view.samples < 2) return;
  const Fan fan = fan_of(view);
  const double loss_db_mm = shaders::us_loss_db_per_mm(kAssumedAttenuationDbCmMhz, 1.0, working_mhz(view));
  const auto met_mm = [&](int b) { return static_cast<double>(mirrors[static_cast<std::size_t>(b)].met.x); };
  const auto level = [&](int b, int k) {
    return static_cast<double>(
        picture.envelope[static_cast<std::size_t>(b) * static_cast<std::size_t>(view.samples) +
                         static_cast<std::size_t>(k)]);
  };
  const auto seen_in = [&](const UsMirror& mirror, int beam, double depth_mm) {
    const Point seems = point_on(fan, beam, depth_mm);
    const glm::dvec4 there = shaders::us_mirrored(glm::dvec4(mirror.plane), seems.x_mm, seems.z_mm);
    const BeamAndDepth at = beam_and_depth(view, there.x, there.y);
    const double k = at.depth_mm / fan.sample_mm - 0.5;
    if (!(at.beam >= 0.0 && at.beam <= view.beams - 1 && k >= 0.0 && k <= view.samples - 1)) return 0.0;
    const int near = std::min(static_cast<int>(at.beam), view.beams - 2);
    const int upper = std::min(static_cast<int>(k), view.samples - 2);
    // Behind the mirror there is nothing to be mirrored: no sample is read that is written here.
    if (at.depth_mm + fan.sample_mm > std::min(met_mm(near), met_mm(near + 1))) return 0.0;
    const double across = at.beam - near, down = k - upper;
    const double above = std::lerp(level(near, upper), level(near + 1, upper), across);
    const double below = std::lerp(level(near, upper + 1), level(near + 1, upper + 1), across);
    return static_cast<double>(mirror.met.y) * shaders::us_later(loss_db_mm, at.depth_mm, depth_mm) *
           std::lerp(above, below, down);
  };
  base::over_rows(view.beams, view.threads, [&](int b) {
    const UsMirror& mirror = mirrors[static_cast<std::size_t>(b)];
    if (mirror.met.y == 0.0F) return;
    const int first = static_cast<int>(met_mm(b) / fan.sample_mm - 0.5) + 1;
    for (int k = first; k < view.samples; ++k) {
      const double more = seen_in(mirror, b, (k + 0.5) * fan.sample_mm);
      float& here = picture.envelope[static_cast<std::size_t>(b) * static_cast<std::size_t>(view.samples) +
                                     static_cast<std::size_t>(k)];
      if (more > 0.0) here = static_cast<float>(std::hypot(static_cast<double>(here), more));
    }
  });
}

}  // namespace seldinger::imaging
