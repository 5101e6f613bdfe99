#include "sim/imaging/ultrasound/motion.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "shaders/shared/ultrasound_cube.glsl.h"
#include "sim/imaging/ultrasound/view.h"

namespace seldinger::imaging {
namespace {

// Of a picture's depth; errors of both are measured by `bench --stage ultrasound` (docs/decisions/0025).
constexpr double kNodesADepth = 40.0, kFanNodesADepth = 50.0;
constexpr double kLeastSpacingMm = 1.0;
constexpr double kBesideMm = 2.0;  // of the grid, around the places that were looked at
constexpr int kLooks = 8;          // along and across the picture, for what of the tissue at rest it shows
constexpr tissue::InverseSteps kLook{.fixed_point = 4, .newton = 0};

double spacing_mm(const UltrasoundView& view, double nodes) {
  return std::max(kLeastSpacingMm, view.depth_mm / nodes);
}

// How far beside its own beams a picture looks, in beams.
double beside_of(const UltrasoundView& view, const Fan& fan) {
  double beams = 1.0;
  for (int i = 0; i <= kLooks; ++i) {
    const double depth_mm = std::max(0.01, view.depth_mm * i / kLooks);
    const BeamWidth width = beam_width(view.probe, working_mhz(view), view.focus_mm, depth_mm);
    beams = std::max(beams, 1.0 + shaders::kUsReachSigmas * width.lateral_sigma_mm / fan.beam_spacing_mm(depth_mm));
  }
  return beams;
}

double half_thickness_mm(const UltrasoundView& view, double depth_mm) {
  if (view.method != UltrasoundMethod::scatterers) return 0.0;
  return shaders::kUsReachSigmas *
         beam_width(view.probe, working_mhz(view), view.focus_mm, std::max(0.01, depth_mm)).elevation_sigma_mm;
}

tissue::SlabPart part_of(const UltrasoundView& view, const Fan& fan, double beside,
                         const tissue::Displacement& displacement) {
  tissue::SlabPart part;
  part.origin_lps_mm = fan.origin_lps_mm;
  part.normal = fan.elevation;
  part.spacing_mm = part.layer_mm = spacing_mm(view, kNodesADepth);
  const int axis = tissue::MovedSlab::column_axis(part.normal);
  part.low_mm = glm::dvec3(std::numeric_limits<double>::infinity());
  part.high_mm = -part.low_mm;
  for (int b = 0; b <= kLooks; ++b) {
    const double beam = -beside + (view.beams - 1.0 + 2.0 * beside) * b / kLooks;
    const glm::dvec3 start = fan.start_lps_mm(beam), direction = fan.direction(beam);
    for (int d = 0; d <= kLooks; ++d) {
      const double depth_mm = view.depth_mm * d / kLooks, half_mm = half_thickness_mm(view, depth_mm);
      for (const double side : {-1.0, 0.0, 1.0}) {
        const glm::dvec3 rest =
            tissue::rest_of(displacement, start + depth_mm * direction + side * half_mm * fan.elevation, kLook);
        const glm::dvec3 at(rest[(axis + 1) % 3], rest[(axis + 2) % 3],
                            glm::dot(part.normal, rest - part.origin_lps_mm));
        part.low_mm = glm::min(part.low_mm, at);
        part.high_mm = glm::max(part.high_mm, at);
      }
    }
  }
  part.low_mm -= kBesideMm;
  part.high_mm += kBesideMm;
  return part;
}

}  // namespace

RestFan::RestFan(const UltrasoundView& view, double spacing_mm, double beside, const RestOf& rest_of)
    : fan_(fan_of(view)) {
  const double beams = view.beams - 1.0 + 2.0 * beside;
  rows_ = std::max(1, static_cast<int>(std::ceil(beams * fan_.beam_spacing_mm(view.depth_mm) / spacing_mm))) + 1;
  depths_ = std::max(1, static_cast<int>(std::ceil(view.depth_mm / spacing_mm))) + 1;
  first_beam_ = -beside;
  rows_per_beam_ = (rows_ - 1) / beams;
  depths_per_mm_ = (depths_ - 1) / view.depth_mm;
  back_mm_.reserve(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(depths_));
  for (int row = 0; row < rows_; ++row) {
    const double beam = first_beam_ + row / rows_per_beam_;
    const glm::dvec3 start = fan_.start_lps_mm(beam), direction = fan_.direction(beam);
    glm::dvec3 back_mm(0.0);
    for (int d = 0; d < depths_; ++d) {
      const glm::dvec3 at = start + (d / depths_per_mm_) * direction;
      back_mm = rest_of(at, at + back_mm) - at;
      back_mm_.push_back(back_mm);
    }
  }
}

RestFan::Between RestFan::between(double beam) const noexcept {
  const double at = (beam - first_beam_) * rows_per_beam_;
  const int row = at > 0.0 ? static_cast<int>(std::min(at, rows_ - 2.0)) : 0;
  const glm::dvec3* low = back_mm_.data() + static_cast<std::ptrdiff_t>(row) * depths_;
  return {low, low + depths_, at - row};
}

glm::dvec3 RestFan::rest_of(double beam, double depth_mm) const noexcept {
  const Between rows = between(beam);
  const double at = depth_mm * depths_per_mm_;
  const int d = at > 0.0 ? static_cast<int>(std::min(at, depths_ - 2.0)) : 0;
  const glm::dvec3 upper = rows.low[d] + rows.part * (rows.high[d] - rows.low[d]),
                   lower = rows.low[d + 1] + rows.part * (rows.high[d + 1] - rows.low[d + 1]);
  return fan_.start_lps_mm(beam) + depth_mm * fan_.direction(beam) + upper + (at - d) * (lower - upper);
}

BeamPath RestFan::path(double beam) const {
  const Between rows = between(beam);
  std::vector<glm::dvec3> back_mm(static_cast<std::size_t>(depths_));
  for (int d = 0; d < depths_; ++d)
    back_mm[static_cast<std::size_t>(d)] = rows.low[d] + rows.part * (rows.high[d] - rows.low[d]);
  return {fan_.start_lps_mm(beam), fan_.direction(beam), std::move(back_mm), depths_per_mm_};
}

PictureMotion::PictureMotion(const UltrasoundView& view, const tissue::Displacement& displacement)
    : slab_(displacement, part_of(view, fan_of(view), beside_of(view, fan_of(view)), displacement)),
      fan_(view, spacing_mm(view, kFanNodesADepth), beside_of(view, fan_of(view)),
           [this](const glm::dvec3& at_lps_mm, const glm::dvec3& guess_lps_mm) {
             return slab_.rest_of(at_lps_mm, guess_lps_mm);
           }) {}

glm::dvec3 PictureMotion::normal_now(const glm::dvec3& rest_lps_mm,
                                     const glm::dvec3& normal_at_rest) const noexcept {
  const glm::dmat3 f = slab_.stretch(rest_lps_mm);
  return glm::normalize(normal_at_rest.x * glm::cross(f[1], f[2]) + normal_at_rest.y * glm::cross(f[2], f[0]) +
                        normal_at_rest.z * glm::cross(f[0], f[1]));
}

std::optional<PictureMotion> motion_of(const UltrasoundView& view, const tissue::Displacement& displacement) {
  if (tissue::count_sources(displacement) == 0) return std::nullopt;
  return std::optional<PictureMotion>(std::in_place, view, displacement);
}

}  // namespace seldinger::imaging
