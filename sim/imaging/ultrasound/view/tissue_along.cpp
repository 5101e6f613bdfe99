#include "sim/imaging/ultrasound/view/tissue_along.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "sim/base/check.h"
#include "sim/base/clones.h"

namespace seldinger::imaging {

using volume::TissueClass;

struct SideBySide {
  static constexpr std::size_t kRoom = 64;
  std::size_t count = 0;
  double depth_mm[kRoom];
  double x[kRoom], y[kRoom], z[kRoom];
  std::int32_t i[kRoom], j[kRoom], k[kRoom];  // voxels; −1: outside
};

namespace {

SELDINGER_FOR_AVX2_TOO
void go_straight(const glm::dvec3& start, const glm::dvec3& direction, SideBySide& at) noexcept {
  const glm::dvec3 from = start, way = direction;
  for (std::size_t n = 0; n < at.count; ++n) {
    at.x[n] = from.x + at.depth_mm[n] * way.x;
    at.y[n] = from.y + at.depth_mm[n] * way.y;
    at.z[n] = from.z + at.depth_mm[n] * way.z;
  }
}

// Those from `first` to `end`, which lie between two nodes.
SELDINGER_FOR_AVX2_TOO
void go_aside(const glm::dvec3& at_node, const glm::dvec3& to_next, double node, double per_mm, std::size_t first,
              std::size_t end, SideBySide& at) noexcept {
  const glm::dvec3 low = at_node, way = to_next;
  for (std::size_t n = first; n < end; ++n) {
    const double part = at.depth_mm[n] * per_mm - node;
    at.x[n] = at.x[n] + low.x + part * way.x;
    at.y[n] = at.y[n] + low.y + part * way.y;
    at.z[n] = at.z[n] + low.z + part * way.z;
  }
}

// Index + ½ of a voxel from LPS, by columns.
struct Grid {
  glm::dvec3 a, b, c, d, size;
};
SELDINGER_FOR_AVX2_TOO
void find_voxels(const Grid& grid, SideBySide& at) noexcept {
  const Grid g = grid;
  for (std::size_t n = 0; n < at.count; ++n) {
    const double i = g.a.x * at.x[n] + g.b.x * at.y[n] + g.c.x * at.z[n] + g.d.x;
    const double j = g.a.y * at.x[n] + g.b.y * at.y[n] + g.c.y * at.z[n] + g.d.y;
    const double k = g.a.z * at.x[n] + g.b.z * at.y[n] + g.c.z * at.z[n] + g.d.z;
    const bool inside =
        static_cast<bool>((i >= 0.0) & (j >= 0.0) & (k >= 0.0) & (i < g.size.x) & (j < g.size.y) & (k < g.size.z));
    at.i[n] = static_cast<std::int32_t>(inside ? i : -1.0);
    at.j[n] = static_cast<std::int32_t>(inside ? j : -1.0);
    at.k[n] = static_cast<std::int32_t>(inside ? k : -1.0);
  }
}

SELDINGER_FOR_AVX2_TOO
void square_off(const glm::dvec3& from, const SideBySide& at, double* off_2) noexcept {
  const glm::dvec3 p = from;
  for (std::size_t n = 0; n < at.count; ++n) {
    const double x = at.x[n] - p.x, y = at.y[n] - p.y, z = at.z[n] - p.z;
    off_2[n] = x * x + y * y + z * z;
  }
}

}  // namespace

void BeamPath::at(SideBySide& at) const noexcept {
  go_straight(start_lps_mm_, direction_, at);
  if (back_mm_.empty()) return;
  for (std::size_t first = 0, end = 0; first < at.count; first = end) {
    const std::size_t node = node_at(at.depth_mm[first] * per_mm_);
    while (end < at.count && node_at(at.depth_mm[end] * per_mm_) == node) ++end;
    go_aside(back_mm_[node], back_mm_[node + 1] - back_mm_[node], static_cast<double>(node), per_mm_, first, end,
             at);
  }
}

void TissueAt::of(SideBySide& at, std::span<TissueClass> tissue) const noexcept {
  find_voxels({a_, b_, c_, d_, {nx_, ny_, nz_}}, at);
  for (std::size_t n = 0; n < at.count; ++n)
    tissue[n] =
        at.i[n] < 0
            ? TissueClass::air
            : classes_[std::int64_t{at.i[n]} + row_ * std::int64_t{at.j[n]} + slice_ * std::int64_t{at.k[n]}];
  double off_2[SideBySide::kRoom];
  for (auto sphere = lesions_.rbegin(); sphere != lesions_.rend(); ++sphere) {  // the first of them counts
    square_off(sphere->center_lps_mm, at, off_2);
    for (std::size_t n = 0; n < at.count; ++n)
      if (off_2[n] <= sphere->radius_2)
        tissue[n] = off_2[n] <= sphere->inner_2 ? sphere->inside.tissue : sphere->rim.tissue;
  }
}

void tissue_along(const BeamPath& path, const TissueAt& tissue_at, std::span<const double> depths_mm,
                  std::span<TissueClass> tissue) {
  CHECK(depths_mm.size() == tissue.size());
  SideBySide at;
  for (std::size_t first = 0; first < depths_mm.size(); first += at.count) {
    at.count = std::min(SideBySide::kRoom, depths_mm.size() - first);
    std::copy_n(depths_mm.begin() + static_cast<std::ptrdiff_t>(first), at.count, at.depth_mm);
    path.at(at);
    tissue_at.of(at, tissue.subspan(first, at.count));
  }
}

}  // namespace seldinger::imaging
