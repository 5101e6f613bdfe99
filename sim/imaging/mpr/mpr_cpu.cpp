// The formulas of shaders/shared/mpr.glsl.h in double, threads over rows. Each row knows beforehand which columns
// lie in the volume, which need no clamping, and which a lesion or the needle can reach.
#include <algorithm>
#include <cmath>
#include <optional>
#include <thread>

#include "shaders/shared/mpr.glsl.h"
#include "sim/base/rows.h"
#include "sim/imaging/mpr/mpr.h"
#include "sim/imaging/mpr/plane.h"
#include "sim/imaging/segment_clip.h"

namespace seldinger::imaging {
namespace {

static_assert(shaders::kMprOutsideHu == volume::kAirHu);
static_assert(shaders::kMprMaxLesions == kMaxLesions);

struct Columns {
  int first = 0, end = 0;
};

Columns both(Columns a, Columns b) {
  return {std::max(a.first, b.first), std::min(a.end, b.end)};
}

// The first column for which `holds` turns true; it stays true from there on.
template <typename Predicate>
int first_column(int width, Predicate holds) {
  int low = 0, high = width;
  while (low < high) {
    const int middle = low + (high - low) / 2;
    if (holds(middle))
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

// Columns whose coordinate start + column·step, as rounded, lies in [low, high]. Rounding keeps the order of the
// coordinates, so the columns are consecutive and bisection with the very expression of the pixel finds them
// exactly.
Columns columns_between(double start, double step, double low, double high, int width) {
  const auto coordinate = [&](int column) { return start + shaders::real(column) * step; };
  if (step < 0.0)
    return {first_column(width, [&](int c) { return coordinate(c) <= high; }),
            first_column(width, [&](int c) { return !(coordinate(c) >= low); })};
  return {first_column(width, [&](int c) { return coordinate(c) >= low; }),
          first_column(width, [&](int c) { return !(coordinate(c) <= high); })};
}

class Painter {
 public:
  Painter(const volume::Volume& volume, const MprView& view, const Inserted& inserted,
          const tissue::Displacement& displacement, HuImage& image)
      : volume_(volume),
        view_(view),
        inserted_(inserted),
        voxel_from_lps_(volume::voxel_from_lps(volume)),
        plane_(plane_from_view(voxel_from_lps_, view)),
        needle_(inserted.needle && is_finite(*inserted.needle) ? &*inserted.needle : nullptr),
        image_(image) {
    if (tissue::count_sources(displacement) > 0) at_rest_.emplace(rest_plane_of(view, displacement));
  }

  void paint_row(int row) const {
    float* pixels = image_.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(view_.width_px);
    const glm::dvec3 row_mm = shaders::mpr_row_start(plane_.position_first_mm, plane_.position_per_row_mm, row);
    if (at_rest_) {
      paint_displaced(row, pixels);
    } else {
      paint_volume(row, pixels);
      // Backwards, so that the first lesion that contains a point is the last to write.
      for (auto lesion = inserted_.lesions.rbegin(); lesion != inserted_.lesions.rend(); ++lesion)
        if (!lesion->in_volume()) paint_lesion(*lesion, row_mm, pixels);
    }
    if (needle_ != nullptr) paint_needle(row_mm, pixels);
  }

 private:
  // Beyond rounding of the estimates that choose columns; the pixels themselves are tested by the shared formulas.
  static constexpr double kMarginMm = 0.01;

  void paint_volume(int row, float* pixels) const {
    const glm::dvec3 start = shaders::mpr_row_start(plane_.index_first, plane_.index_per_row, row);
    const glm::dvec3& step = plane_.index_per_column;
    Columns inside{0, view_.width_px}, unclamped{0, view_.width_px};
    for (int axis = 0; axis < 3; ++axis) {
      const double n = volume_.size_voxels[axis];
      inside = both(inside, columns_between(start[axis], step[axis], -0.5, n - 0.5, view_.width_px));
      // Both neighbours exist: 0 ≤ index < n − 1.
      unclamped = both(
          unclamped, columns_between(start[axis], step[axis], 0.0, std::nextafter(n - 1.0, -1.0), view_.width_px));
    }
    if (inside.first >= inside.end) inside = {0, 0};
    if (unclamped.first >= unclamped.end) unclamped = {inside.end, inside.end};
    std::fill(pixels, pixels + inside.first, static_cast<float>(shaders::kMprOutsideHu));
    std::fill(pixels + inside.end, pixels + view_.width_px, static_cast<float>(shaders::kMprOutsideHu));
    if (view_.interpolation == Interpolation::nearest) {
      for (int c = inside.first; c < inside.end; ++c) {
        const glm::ivec3 at = shaders::mpr_nearest(shaders::mpr_in_row(start, step, c), volume_.size_voxels);
        pixels[c] = volume_.at(at.x, at.y, at.z);
      }
      return;
    }
    for (int c = inside.first; c < unclamped.first; ++c)
      pixels[c] = clamped_hu(shaders::mpr_in_row(start, step, c));
    paint_unclamped(start, step, unclamped, pixels);
    for (int c = unclamped.end; c < inside.end; ++c) pixels[c] = clamped_hu(shaders::mpr_in_row(start, step, c));
  }

  // Each pixel by where its tissue was at rest: neighbours in a row are none there.
  void paint_displaced(int row, float* pixels) const {
    for (int c = 0; c < view_.width_px; ++c)
      pixels[c] = rest_hu(at_rest_->rest_of(c * view_.pixel_mm, row * view_.pixel_mm));
  }

  float rest_hu(const glm::dvec3& rest_lps_mm) const {
    for (const cases::Lesion& lesion : inserted_.lesions)
      if (!lesion.in_volume() && shaders::mpr_in_sphere(rest_lps_mm - lesion.center_lps_mm, lesion.radius_mm))
        return static_cast<float>(lesion.hu);
    const glm::dvec3 index(voxel_from_lps_ * glm::dvec4(rest_lps_mm, 1.0));
    if (!shaders::mpr_inside(index, volume_.size_voxels)) return static_cast<float>(shaders::kMprOutsideHu);
    if (view_.interpolation == Interpolation::linear) return clamped_hu(index);
    const glm::ivec3 at = shaders::mpr_nearest(index, volume_.size_voxels);
    return volume_.at(at.x, at.y, at.z);
  }

  float clamped_hu(const glm::dvec3& index) const {
    const glm::dvec3 clamped = shaders::mpr_clamped(index, volume_.size_voxels);
    const glm::ivec3 low(clamped), high = glm::min(low + 1, volume_.size_voxels - 1);
    const auto& v = volume_;
    return static_cast<float>(shaders::mpr_trilinear({v.at(low.x, low.y, low.z), v.at(high.x, low.y, low.z),
                                                      v.at(low.x, high.y, low.z), v.at(high.x, high.y, low.z)},
                                                     {v.at(low.x, low.y, high.z), v.at(high.x, low.y, high.z),
                                                      v.at(low.x, high.y, high.z), v.at(high.x, high.y, high.z)},
                                                     clamped - glm::dvec3(low)));
  }

  void paint_unclamped(const glm::dvec3& start, const glm::dvec3& step, Columns columns, float* pixels) const {
    const std::ptrdiff_t row_stride = volume_.size_voxels.x;
    const std::ptrdiff_t slice_stride = row_stride * volume_.size_voxels.y;
    for (int c = columns.first; c < columns.end; ++c) {
      const glm::dvec3 index = shaders::mpr_in_row(start, step, c);
      const glm::ivec3 low(index);
      const std::int16_t* front = volume_.hu.data() + low.x + low.y * row_stride + low.z * slice_stride;
      const std::int16_t* back = front + slice_stride;
      pixels[c] = static_cast<float>(shaders::mpr_trilinear(
          {front[0], front[1], front[row_stride], front[row_stride + 1]},
          {back[0], back[1], back[row_stride], back[row_stride + 1]}, index - glm::dvec3(low)));
    }
  }

  // Columns whose distance along u from the view's centre lies in [low, high], a pixel more on each side.
  Columns columns_near(double low_mm, double high_mm) const {
    const double first_mm = -0.5 * view_.pixel_mm * (view_.width_px - 1);
    const double width = view_.width_px;
    const double first = std::clamp(std::floor((low_mm - first_mm) / view_.pixel_mm) - 1.0, 0.0, width);
    const double end = std::clamp(std::ceil((high_mm - first_mm) / view_.pixel_mm) + 2.0, 0.0, width);
    return {static_cast<int>(first), static_cast<int>(end)};
  }

  void paint_lesion(const cases::Lesion& lesion, const glm::dvec3& row_mm, float* pixels) const {
    const glm::dvec3 center_mm = lesion.center_lps_mm - view_.center_lps_mm;
    const double across_mm = glm::dot(center_mm - row_mm, view_.v), reach_mm = lesion.radius_mm + kMarginMm;
    const double chord_2 = reach_mm * reach_mm - across_mm * across_mm;
    if (!(chord_2 > 0.0)) return;
    const double middle_mm = glm::dot(center_mm, view_.u), half_mm = std::sqrt(chord_2);
    if (!std::isfinite(middle_mm)) return;
    const Columns columns = columns_near(middle_mm - half_mm, middle_mm + half_mm);
    for (int c = columns.first; c < columns.end; ++c) {
      const glm::dvec3 p_mm = shaders::mpr_in_row(row_mm, plane_.position_per_column_mm, c);
      if (shaders::mpr_in_sphere(p_mm - center_mm, lesion.radius_mm)) pixels[c] = static_cast<float>(lesion.hu);
    }
  }

  void paint_needle(const glm::dvec3& row_mm, float* pixels) const {
    const glm::dvec3 tip_mm = needle_->tip_lps_mm - view_.center_lps_mm;
    const glm::dvec3 shaft_mm = -needle_->length_mm * needle_->direction;
    const double half_mm = 0.5 * view_.needle_slab_mm, reach_mm = needle_->radius_mm + kMarginMm;
    // What a row shows is no further than the radius from the part of the axis that is near both slab and row.
    SegmentPart part = clip({}, glm::dot(tip_mm, plane_.normal), glm::dot(shaft_mm, plane_.normal),
                            -half_mm - reach_mm, half_mm + reach_mm);
    part = clip(part, glm::dot(tip_mm - row_mm, view_.v), glm::dot(shaft_mm, view_.v), -reach_mm, reach_mm);
    if (!(part.from <= part.to)) return;
    const double tip_u_mm = glm::dot(tip_mm, view_.u), shaft_u_mm = glm::dot(shaft_mm, view_.u);
    const double one_mm = tip_u_mm + part.from * shaft_u_mm, other_mm = tip_u_mm + part.to * shaft_u_mm;
    if (!std::isfinite(one_mm) || !std::isfinite(other_mm)) return;
    const Columns columns =
        columns_near(std::min(one_mm, other_mm) - reach_mm, std::max(one_mm, other_mm) + reach_mm);
    const double normal_along = glm::dot(plane_.normal, needle_->direction);
    const glm::dvec3 normal_across = plane_.normal - normal_along * needle_->direction;
    for (int c = columns.first; c < columns.end; ++c) {
      const glm::dvec3 p_mm = shaders::mpr_in_row(row_mm, plane_.position_per_column_mm, c);
      const int shown =
          shaders::mpr_needle_part(p_mm - tip_mm, needle_->direction, normal_across, normal_along,
                                   needle_->length_mm, needle_->radius_mm, needle_->inner_radius_mm, half_mm);
      if (shown != 0) pixels[c] = static_cast<float>(shown == 1 ? needle_->hu : shaders::kMprLumenHu);
    }
  }

  const volume::Volume& volume_;
  const MprView& view_;
  const Inserted& inserted_;
  glm::dmat4 voxel_from_lps_;
  Plane plane_;
  std::optional<tissue::RestPlane> at_rest_;  // nothing where nothing moves
  const NeedlePose* needle_;
  HuImage& image_;
};

}  // namespace

HuImage mpr_cpu(const volume::Volume& volume, const MprView& view, const Inserted& inserted) {
  return mpr_cpu(volume, view, inserted, tissue::Displacement{});
}

HuImage mpr_cpu(const volume::Volume& volume, const MprView& view, const Inserted& inserted,
                const tissue::Displacement& displacement) {
  check_view(view, inserted);
  HuImage image(static_cast<std::size_t>(view.width_px) * static_cast<std::size_t>(view.height_px));
  const Painter painter(volume, view, inserted, displacement, image);
  constexpr int kRowsAtOnce = 16;
  // A thread costs about as much as 10 000 pixels.
  constexpr std::size_t kPixelsPerThread = 32768;
  const std::size_t useful =
      std::min<std::size_t>(std::thread::hardware_concurrency(), image.size() / kPixelsPerThread);
  base::over_rows((view.height_px + kRowsAtOnce - 1) / kRowsAtOnce, std::max(1, static_cast<int>(useful)),
                  [&](int i) {
                    for (int row = i * kRowsAtOnce; row < std::min((i + 1) * kRowsAtOnce, view.height_px); ++row)
                      painter.paint_row(row);
                  });
  return image;
}

}  // namespace seldinger::imaging
