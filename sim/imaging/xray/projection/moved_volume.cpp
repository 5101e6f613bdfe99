#include "sim/imaging/xray/projection/moved_volume.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>

#include "shaders/shared/xray.glsl.h"
#include "sim/base/check.h"

namespace seldinger::imaging {
namespace {

// On each side of the beam, in moved voxels: what instruments and truth ask for beside a ray through the outermost
// pixel.
constexpr int kMargin = 2;

bool same(const tissue::Displacement& a, const tissue::Displacement& b) noexcept {
  if (a.contact_end != b.contact_end || a.tip_end != b.tip_end || a.shaft_end != b.shaft_end ||
      a.organ_end != b.organ_end || a.vein_end != b.vein_end || a.breath_end != b.breath_end)
    return false;
  const auto equal = [](const auto& one, const auto& other) {
    return one.x == other.x && one.y == other.y && one.z == other.z && one.w == other.w;
  };
  for (int i = 0; i < tissue::count_sources(a); ++i) {
    const auto &one = a.source[i], &other = b.source[i];
    if (!equal(one.place_mm, other.place_mm) || !equal(one.along, other.along) ||
        !equal(one.size_mm, other.size_mm) || !equal(one.amount, other.amount))
      return false;
  }
  return true;
}

glm::dvec3 lps_of(const volume::Volume& volume, const glm::dvec3& index) {
  return glm::dvec3(volume.lps_from_voxel * glm::dvec4(index, 1.0));
}

glm::dvec3 corner_of(const glm::dvec3& low, const glm::dvec3& high, int corner) {
  return low + (high - low) * glm::dvec3(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
}

// How far tissue goes, at most: from places a hand's breadth apart, and a little more.
double reach_of(const volume::Volume& volume, const tissue::Displacement& displacement) {
  constexpr double kApartMm = 40.0, kMoreMm = 2.0;
  const glm::dvec3 size_mm = glm::dvec3(volume.size_voxels) * volume.spacing_mm;
  const glm::ivec3 steps = glm::max(glm::ivec3(glm::ceil(size_mm / kApartMm)), 1);
  double most_mm = 0.0;
  for (int k = 0; k <= steps.z; ++k)
    for (int j = 0; j <= steps.y; ++j)
      for (int i = 0; i <= steps.x; ++i) {
        const glm::dvec3 at =
            lps_of(volume, glm::dvec3(i, j, k) / glm::dvec3(steps) * glm::dvec3(volume.size_voxels) - 0.5);
        most_mm = std::max(most_mm, glm::length(tissue::displaced(displacement, at) - at));
      }
  return most_mm + kMoreMm;
}

}  // namespace

RayLengths displaced_lengths_between(const volume::Volume& rest, const tissue::Displacement& displacement,
                                     const glm::dvec3& from_lps_mm, const glm::dvec3& to_lps_mm, double step_mm) {
  const glm::dmat4 voxel_from_lps = volume::voxel_from_lps(rest);
  const double length_mm = glm::length(to_lps_mm - from_lps_mm);
  const int steps = std::max(1, static_cast<int>(std::ceil(length_mm / step_mm)));
  RayLengths lengths;
  for (int i = 0; i < steps; ++i) {
    const glm::dvec3 at = from_lps_mm + (i + 0.5) / steps * (to_lps_mm - from_lps_mm);
    const glm::dvec3 index(voxel_from_lps * glm::dvec4(tissue::rest_of(displacement, at), 1.0));
    const auto hu = volume::sample_nearest(rest, index);
    if (!hu) continue;
    lengths.water_mm += length_mm / steps * shaders::xray_water(*hu);
    lengths.mineral_mm += length_mm / steps * shaders::xray_mineral(*hu);
  }
  return lengths;
}

glm::ivec3 joined_voxels(const volume::Volume& rest, const MovedVolumeGrid& grid) {
  CHECK(grid.voxel_mm > 0.0);
  glm::ivec3 joined(1);
  for (int axis = 0; axis < 3; ++axis)
    joined[axis] = std::max(1, static_cast<int>(grid.voxel_mm / rest.spacing_mm[axis] + 1e-6));
  return joined;
}

MovedVolume::MovedVolume(const volume::Volume& rest, const MovedVolumeGrid& grid)
    : rest_(rest), grid_(grid), voxel_from_lps_(volume::voxel_from_lps(rest)) {
  CHECK(grid.node_mm > 0.0);
  joined_ = joined_voxels(rest, grid);
  for (int axis = 0; axis < 3; ++axis) {
    cell_[axis] = std::max(1, static_cast<int>(grid.node_mm / (rest.spacing_mm[axis] * joined_[axis])));
  }
}

bool MovedVolume::move(const tissue::Displacement& displacement, const XrayGeometry& geometry) {
  const bool still = projector_ && same(displacement, displacement_);
  const Box box = box_of(geometry, reach_of(rest_, displacement));
  if (still && box == box_) return false;
  displacement_ = displacement;
  box_ = box;
  find_nodes(box);
  resample(box);
  projector_.emplace(moved_);
  return true;
}

// The beam between the two planes, parallel to the panel, that hold the patient; not beyond where he can be.
MovedVolume::Box MovedVolume::box_of(const XrayGeometry& geometry, double reach_mm) const {
  const glm::dvec3 reach = reach_mm / rest_.spacing_mm;
  const glm::dvec3 first = glm::dvec3(-0.5) - reach, last = glm::dvec3(rest_.size_voxels) - 0.5 + reach;
  glm::dvec3 low = first, high = last;
  if (geometry.source_lps_mm) {
    const glm::dvec3 normal = glm::cross(geometry.u, geometry.v);
    const glm::dvec3 to_panel = geometry.detector_center_lps_mm - *geometry.source_lps_mm;
    const double panel_mm = glm::dot(to_panel, normal);
    double near = 1.0, far = 0.0;  // shares of the way
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 at = lps_of(rest_, corner_of(first, last, corner));
      const double share = glm::dot(at - *geometry.source_lps_mm, normal) / panel_mm;
      near = std::min(near, std::max(0.0, share));
      far = std::max(far, std::min(1.0, share));
    }
    low = glm::dvec3(std::numeric_limits<double>::infinity());
    high = -low;
    for (const double share : {near, far})
      for (int corner = 0; corner < 4; ++corner) {
        const double u_mm = (corner % 2 - 0.5) * geometry.pixel_mm * geometry.width_px;
        const double v_mm = (corner / 2 - 0.5) * geometry.pixel_mm * geometry.height_px;
        const glm::dvec3 at = *geometry.source_lps_mm + share * (to_panel + u_mm * geometry.u + v_mm * geometry.v);
        const glm::dvec3 index(voxel_from_lps_ * glm::dvec4(at, 1.0));
        low = glm::min(low, index);
        high = glm::max(high, index);
      }
    low = glm::clamp(low, first, last);
    high = glm::clamp(high, first, last);
  }
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const int begin = static_cast<int>(std::floor(low[axis] / joined_[axis])) - kMargin;
    const int end = static_cast<int>(std::ceil(high[axis] / joined_[axis])) + kMargin;
    box.low[axis] = begin * joined_[axis];
    box.size[axis] = end - begin;
  }
  return box;
}

void MovedVolume::find_nodes(const Box& box) {
  cells_ = (box.size + cell_ - 1) / cell_;
  const glm::dmat3 turn(voxel_from_lps_);
  const glm::dvec3 joined(joined_), first = glm::dvec3(box.low) + 0.5 * (joined - 1.0);
  nodes_.clear();
  for (int k = 0; k <= cells_.z; ++k)
    for (int j = 0; j <= cells_.y; ++j)
      for (int i = 0; i <= cells_.x; ++i) {
        const glm::dvec3 at = lps_of(rest_, first + joined * glm::dvec3(glm::ivec3(i, j, k) * cell_));
        const glm::dvec3 rest = tissue::rest_of(displacement_, at, {.fixed_point = 4, .newton = 1});
        nodes_.push_back(glm::vec3(turn * (rest - at)));
      }
}

void MovedVolume::resample(const Box& box) {
  // The moved volume: this box of the patient's, `joined_` voxels made one.
  const glm::vec3 joined(joined_), first = glm::vec3(box.low) + 0.5F * (joined - 1.0F);
  moved_.size_voxels = box.size;
  moved_.spacing_mm = rest_.spacing_mm * glm::dvec3(joined_);
  moved_.lps_from_voxel = rest_.lps_from_voxel;
  for (int axis = 0; axis < 3; ++axis) moved_.lps_from_voxel[axis] *= joined_[axis];
  moved_.lps_from_voxel[3] = glm::dvec4(lps_of(rest_, glm::dvec3(first)), 1.0);
  moved_.hu.resize(static_cast<std::size_t>(box.size.x) * static_cast<std::size_t>(box.size.y) *
                   static_cast<std::size_t>(box.size.z));

  // Trilinear interpolation at rest, for places from 0 to size − 1; at the last voxel the neighbour is itself.
  const glm::ivec3 size = rest_.size_voxels;
  const std::ptrdiff_t row_stride = size.x, slice_stride = std::ptrdiff_t{size.x} * size.y;
  const glm::ivec3 inner = glm::max(size - 2, 0);  // the last voxel with a neighbour above it
  const std::ptrdiff_t next_x = size.x > 1 ? 1 : 0, next_y = size.y > 1 ? row_stride : 0,
                       next_z = size.z > 1 ? slice_stride : 0;
  const glm::vec3 low_face(-0.5F), high_face = glm::vec3(size) - 0.5F;
  const std::int16_t* hu = rest_.hu.data();
  // HU + kAbove is positive, so that cutting it off rounds.
  constexpr float kAbove = 1024.5F;
  static_assert(volume::kAirHu == -1024);
  const auto trilinear = [&](float x, float y, float z) {
    const int ix = std::min(static_cast<int>(x), inner.x), iy = std::min(static_cast<int>(y), inner.y),
              iz = std::min(static_cast<int>(z), inner.z);
    const float tx = x - static_cast<float>(ix), ty = y - static_cast<float>(iy), tz = z - static_cast<float>(iz);
    const std::int16_t* at = hu + iz * slice_stride + iy * row_stride + ix;
    const auto along = [&](const std::int16_t* from) {
      const auto a = static_cast<float>(from[0]), b = static_cast<float>(from[next_x]);
      return a + tx * (b - a);
    };
    const float a = along(at), b = along(at + next_y), c = along(at + next_z), d = along(at + next_z + next_y);
    const float lower = a + ty * (b - a), upper = c + ty * (d - c);
    const float value = lower + tz * (upper - lower);
    return static_cast<std::int16_t>(static_cast<int>(value + kAbove) - 1024);
  };

  // Row by row: where the tissue at the row's cell borders lies at rest, from the nodes around. Within a cell,
  // places go in equal steps from border to border.
  const int node_row = cells_.x + 1, node_slice = node_row * (cells_.y + 1);
  std::vector<glm::vec3> line(static_cast<std::size_t>(node_row));
  std::int16_t* out = moved_.hu.data();
  for (int k = 0; k < box.size.z; ++k)
    for (int j = 0; j < box.size.y; ++j) {
      const int cell_y = j / cell_.y, cell_z = k / cell_.z;
      const float ty = static_cast<float>(j - cell_y * cell_.y) / static_cast<float>(cell_.y);
      const float tz = static_cast<float>(k - cell_z * cell_.z) / static_cast<float>(cell_.z);
      const glm::vec3* node =
          nodes_.data() + std::ptrdiff_t{cell_z} * node_slice + std::ptrdiff_t{cell_y} * node_row;
      for (int i = 0; i < node_row; ++i, ++node) {
        const glm::vec3 lower = node[0] + ty * (node[node_row] - node[0]);
        const glm::vec3 upper = node[node_slice] + ty * (node[node_slice + node_row] - node[node_slice]);
        line[static_cast<std::size_t>(i)] =
            first + joined * glm::vec3(i * cell_.x, j, k) + lower + tz * (upper - lower);
      }
      // The row's voxels, cell by cell; the last cell may be cut short.
      for (int cell = 0; cell < cells_.x; ++cell) {
        const int count = std::min(cell_.x, box.size.x - cell * cell_.x);
        const glm::vec3 from = line[static_cast<std::size_t>(cell)];
        const glm::vec3 step = (line[static_cast<std::size_t>(cell) + 1] - from) / static_cast<float>(cell_.x);
        const glm::vec3 to = from + static_cast<float>(count) * step;
        const glm::vec3 least = glm::min(from, to), most = glm::max(from, to);
        // All inside, all outside, or checked one by one.
        const glm::vec3 highest(size - 1);
        if (glm::all(glm::greaterThanEqual(least, glm::vec3(0.0F))) &&
            glm::all(glm::lessThanEqual(most, highest))) {
          for (int i = 0; i < count; ++i) {
            const glm::vec3 at = from + static_cast<float>(i) * step;
            *out++ = trilinear(at.x, at.y, at.z);
          }
        } else if (glm::any(glm::lessThan(most, low_face)) || glm::any(glm::greaterThan(least, high_face))) {
          out = std::fill_n(out, count, volume::kAirHu);
        } else {
          for (int i = 0; i < count; ++i) {
            const glm::vec3 at = from + static_cast<float>(i) * step;
            const bool within =
                glm::all(glm::greaterThanEqual(at, low_face)) && glm::all(glm::lessThan(at, high_face));
            const glm::vec3 held = glm::clamp(at, glm::vec3(0.0F), highest);
            *out++ = within ? trilinear(held.x, held.y, held.z) : volume::kAirHu;
          }
        }
      }
    }
}

}  // namespace seldinger::imaging
