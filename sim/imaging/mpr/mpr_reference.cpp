// The oracle: one pixel at a time, in double, with formulas of its own (none of shaders/shared).
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/imaging/mpr/mpr.h"
#include "sim/imaging/mpr/plane.h"
#include "sim/volume/volume.h"

namespace seldinger::imaging {
namespace {

enum class NeedlePart { nothing, metal, lumen };

struct Interval {
  double low, high;
};

Interval both(const Interval& a, const Interval& b) {
  return {std::max(a.low, b.low), std::min(a.high, b.high)};
}

// Where along y the line p + y·n is between the needle's flat ends and within its radius: the overlap of three
// intervals in y, from the roots of the axial lines and of the quadratic of the distance to the axis.
bool segment_meets_cylinder(const glm::dvec3& p_mm, const glm::dvec3& n, double half_mm, const NeedlePose& needle) {
  constexpr Interval kEverywhere{-1e300, 1e300}, kNowhere{1e300, -1e300};
  const glm::dvec3 hub_mm = needle.tip_lps_mm - needle.length_mm * needle.direction;
  const glm::dvec3 from_hub_mm = p_mm - hub_mm;

  const double along = glm::dot(from_hub_mm, needle.direction), along_per_y = glm::dot(n, needle.direction);
  Interval axial = kEverywhere;
  if (std::abs(along_per_y) > 1e-12) {
    const double at_hub = -along / along_per_y, at_tip = (needle.length_mm - along) / along_per_y;
    axial = {std::min(at_hub, at_tip), std::max(at_hub, at_tip)};
  } else if (!(along >= 0.0 && along <= needle.length_mm)) {
    axial = kNowhere;
  }

  // |(p − hub + y·n) × direction|² ≤ r²
  const glm::dvec3 c = glm::cross(from_hub_mm, needle.direction), c_per_y = glm::cross(n, needle.direction);
  const double a = glm::dot(c_per_y, c_per_y), b = glm::dot(c, c_per_y);
  const double excess = glm::dot(c, c) - needle.radius_mm * needle.radius_mm;
  Interval radial = kNowhere;
  if (a > 1e-24) {
    const double discriminant = b * b - a * excess;
    if (discriminant >= 0.0) radial = {(-b - std::sqrt(discriminant)) / a, (-b + std::sqrt(discriminant)) / a};
  } else if (excess <= 0.0) {
    radial = kEverywhere;
  }

  const Interval shown = both(both(axial, radial), {-half_mm, half_mm});
  return shown.low <= shown.high;
}

NeedlePart part_at_point(const glm::dvec3& p_mm, const NeedlePose& needle) {
  const glm::dvec3 from_tip_mm = p_mm - needle.tip_lps_mm;
  const double along_mm = glm::dot(from_tip_mm, needle.direction);
  if (!(along_mm <= 0.0 && along_mm >= -needle.length_mm)) return NeedlePart::nothing;
  const double off_axis_mm = glm::length(glm::cross(from_tip_mm, needle.direction));
  if (!(off_axis_mm <= needle.radius_mm)) return NeedlePart::nothing;
  return off_axis_mm < needle.inner_radius_mm ? NeedlePart::lumen : NeedlePart::metal;
}

NeedlePart part_at(const glm::dvec3& p_mm, const glm::dvec3& n, double slab_mm, const NeedlePose& needle) {
  if (slab_mm == 0.0) return part_at_point(p_mm, needle);
  return segment_meets_cylinder(p_mm, n, 0.5 * slab_mm, needle) ? NeedlePart::metal : NeedlePart::nothing;
}

}  // namespace

HuImage mpr_reference(const volume::Volume& volume, const MprView& view, const Inserted& inserted) {
  return mpr_reference(volume, view, inserted, tissue::Displacement{});
}

// The one thing it shares with the others is the displacement itself; the way back is walked further.
HuImage mpr_reference(const volume::Volume& volume, const MprView& view, const Inserted& inserted,
                      const tissue::Displacement& displacement) {
  constexpr tissue::InverseSteps kToTheEnd{.fixed_point = 6, .newton = 4};
  check_view(view, inserted);
  constexpr double kAirInLumenHu = -1000.0;
  const glm::dmat4 voxel_from_lps = volume::voxel_from_lps(volume);
  const glm::dvec3 normal = glm::cross(view.u, view.v);
  HuImage image;
  image.reserve(static_cast<std::size_t>(view.width_px) * static_cast<std::size_t>(view.height_px));
  for (int row = 0; row < view.height_px; ++row)
    for (int column = 0; column < view.width_px; ++column) {
      const glm::dvec3 p_lps_mm = view.center_lps_mm +
                                  view.u * (view.pixel_mm * (column - 0.5 * (view.width_px - 1))) +
                                  view.v * (view.pixel_mm * (row - 0.5 * (view.height_px - 1)));
      const glm::dvec3 rest_lps_mm = tissue::rest_of(displacement, p_lps_mm, kToTheEnd);
      const glm::dvec3 index(voxel_from_lps * glm::dvec4(rest_lps_mm, 1.0));
      double hu = view.interpolation == Interpolation::nearest
                      ? volume::sample_nearest(volume, index).value_or(volume::kAirHu)
                      : volume::sample_trilinear(volume, index).value_or(volume::kAirHu);
      for (const cases::Lesion& lesion : inserted.lesions)
        if (!lesion.in_volume() && glm::distance(rest_lps_mm, lesion.center_lps_mm) <= lesion.radius_mm) {
          hu = lesion.hu;
          break;
        }
      if (inserted.needle) {
        const NeedlePart part = part_at(p_lps_mm, normal, view.needle_slab_mm, *inserted.needle);
        if (part == NeedlePart::metal) hu = inserted.needle->hu;
        if (part == NeedlePart::lumen) hu = kAirInLumenHu;
      }
      image.push_back(static_cast<float>(hu));
    }
  return image;
}

}  // namespace seldinger::imaging
