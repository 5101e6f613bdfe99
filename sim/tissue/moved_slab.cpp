#include "sim/tissue/moved_slab.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/base/check.h"

namespace seldinger::tissue {
namespace {

int nodes_over(double size_mm, double spacing_mm) {
  return std::max(2, static_cast<int>(std::ceil(size_mm / spacing_mm)) + 1);
}

// NaN counts as 0.
double within(double value, double most) noexcept {
  return value > 0.0 ? std::min(value, most) : 0.0;
}

}  // namespace

int MovedSlab::column_axis(const glm::dvec3& normal) noexcept {
  int axis = 0;
  for (int l = 1; l < 3; ++l)
    if (std::abs(normal[l]) > std::abs(normal[axis])) axis = l;
  return axis;
}

MovedSlab::MovedSlab(const Displacement& displacement, const SlabPart& part)
    : part_(part),
      axis_(column_axis(part.normal)),
      per_step_(1.0 / part.spacing_mm, 1.0 / part.spacing_mm, 1.0 / part.layer_mm) {
  CHECK(part.spacing_mm > 0.0 && part.layer_mm > 0.0);
  const glm::dvec3 size_mm = part.high_mm - part.low_mm;
  size_ = {nodes_over(size_mm.x, part.spacing_mm), nodes_over(size_mm.y, part.spacing_mm),
           nodes_over(size_mm.z, part.layer_mm)};
  nodes_.reserve(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) *
                 static_cast<std::size_t>(size_.z));
  const int a = (axis_ + 1) % 3, b = (axis_ + 2) % 3;
  std::vector<glm::dvec3> rest_lps_mm, now_lps_mm;  // of a row of columns
  for (int j = 0; j < size_.y; ++j) {
    rest_lps_mm.clear();
    for (int i = 0; i < size_.x; ++i)
      for (int l = 0; l < size_.z; ++l) {
        glm::dvec3& rest = rest_lps_mm.emplace_back();
        rest[a] = part.low_mm.x + i * part.spacing_mm;
        rest[b] = part.low_mm.y + j * part.spacing_mm;
        const double height_mm = part.low_mm.z + l * part.layer_mm;
        rest[axis_] = part.origin_lps_mm[axis_] + (height_mm - part.normal[a] * (rest[a] - part.origin_lps_mm[a]) -
                                                   part.normal[b] * (rest[b] - part.origin_lps_mm[b])) /
                                                      part.normal[axis_];
      }
    now_lps_mm.resize(rest_lps_mm.size());
    displaced(displacement, rest_lps_mm, now_lps_mm);
    for (std::size_t n = 0; n < rest_lps_mm.size(); ++n)
      nodes_.push_back(glm::vec4(glm::dvec4(now_lps_mm[n] - rest_lps_mm[n], 0.0)));
  }
}

glm::dvec3 MovedSlab::slab_of(const glm::dvec3& rest_lps_mm) const noexcept {
  return {rest_lps_mm[(axis_ + 1) % 3], rest_lps_mm[(axis_ + 2) % 3],
          glm::dot(part_.normal, rest_lps_mm - part_.origin_lps_mm)};
}

MovedSlab::Cell MovedSlab::cell_of(const glm::dvec3& slab_mm) const noexcept {
  Cell cell;
  for (int l = 0; l < 3; ++l) {
    const double at = within((slab_mm[l] - part_.low_mm[l]) * per_step_[l], size_[l] - 1.0);
    cell.at[l] = std::min(static_cast<int>(at), size_[l] - 2);
    cell.part[l] = at - cell.at[l];
  }
  return cell;
}

glm::dvec3 MovedSlab::node(const Cell& cell, int right, int down, int up) const noexcept {
  return glm::dvec3(nodes_[index(cell.at.x + right, cell.at.y + down) + static_cast<std::size_t>(cell.at.z + up)]);
}

void MovedSlab::sample(const glm::dvec3& rest_lps_mm, glm::dvec3& moved_mm, glm::dmat3& stretch) const noexcept {
  const Cell cell = cell_of(slab_of(rest_lps_mm));
  const glm::dvec3 t = cell.part;
  glm::dvec3 edge[2][2], by_x[2];  // [down][up], [up]
  for (int down = 0; down < 2; ++down)
    for (int up = 0; up < 2; ++up) {
      const glm::dvec3 low = node(cell, 0, down, up), way = node(cell, 1, down, up) - low;
      edge[down][up] = low + t.x * way;
      by_x[up] = down == 0 ? way : by_x[up] + t.y * (way - by_x[up]);
    }
  const glm::dvec3 lower = edge[0][0] + t.y * (edge[1][0] - edge[0][0]),
                   upper = edge[0][1] + t.y * (edge[1][1] - edge[0][1]);
  moved_mm = lower + t.z * (upper - lower);
  const glm::dvec3 along_x = per_step_.x * (by_x[0] + t.z * (by_x[1] - by_x[0]));
  const glm::dvec3 along_y =
      per_step_.y * ((edge[1][0] - edge[0][0]) + t.z * ((edge[1][1] - edge[0][1]) - (edge[1][0] - edge[0][0])));
  const glm::dvec3 along_z = per_step_.z * (upper - lower);
  // The chain from slab_of's coordinates to LPS.
  stretch = glm::dmat3(1.0);
  stretch[(axis_ + 1) % 3] += along_x;
  stretch[(axis_ + 2) % 3] += along_y;
  for (int l = 0; l < 3; ++l) stretch[l] += part_.normal[l] * along_z;
}

glm::dvec3 MovedSlab::moved_mm(const glm::dvec3& rest_lps_mm) const noexcept {
  glm::dvec3 moved_mm;
  glm::dmat3 stretch;
  sample(rest_lps_mm, moved_mm, stretch);
  return moved_mm;
}

glm::dmat3 MovedSlab::stretch(const glm::dvec3& rest_lps_mm) const noexcept {
  glm::dvec3 moved_mm;
  glm::dmat3 stretch;
  sample(rest_lps_mm, moved_mm, stretch);
  return stretch;
}

glm::dvec3 MovedSlab::rest_of(const glm::dvec3& at_lps_mm, const glm::dvec3& guess_lps_mm,
                              int steps) const noexcept {
  glm::dvec3 rest_mm = guess_lps_mm;
  for (int step = 0; step < steps; ++step) {
    glm::dvec3 moved_mm;
    glm::dmat3 s;
    sample(rest_mm, moved_mm, s);
    const glm::dvec3 miss_mm = at_lps_mm - moved_mm - rest_mm;
    if (miss_mm == glm::dvec3(0.0)) break;  // as where nothing moves
    const glm::dvec3 yz = glm::cross(s[1], s[2]);
    // As displacement.glsl.h's: bounded where tissue is all but folded, and no longer than twice the miss.
    const double per_volume = 1.0 / std::max(glm::dot(s[0], yz), 0.05);
    glm::dvec3 step_mm = per_volume * glm::dvec3(glm::dot(miss_mm, yz), glm::dot(miss_mm, glm::cross(s[2], s[0])),
                                                 glm::dot(miss_mm, glm::cross(s[0], s[1])));
    const double most_2 = 4.0 * glm::dot(miss_mm, miss_mm), length_2 = glm::dot(step_mm, step_mm);
    if (length_2 > most_2) step_mm *= std::sqrt(most_2 / length_2);
    rest_mm += step_mm;
  }
  return rest_mm;
}

MovedSlab::Range MovedSlab::range(const glm::dvec3& low, const glm::dvec3& high,
                                  const glm::dvec3 (&axes)[3]) const noexcept {
  const Cell first = cell_of(low), last = cell_of(high);
  const glm::vec3 x(axes[0]), y(axes[1]), z(axes[2]);
  glm::vec3 least(1e9F), most(-1e9F);
  for (int j = first.at.y; j <= last.at.y + 1; ++j)
    for (int i = first.at.x; i <= last.at.x + 1; ++i) {
      const glm::vec4* column = nodes_.data() + index(i, j);
      for (int l = first.at.z; l <= last.at.z + 1; ++l) {
        const glm::vec3 u(column[l]);
        const glm::vec3 along(glm::dot(u, x), glm::dot(u, y), glm::dot(u, z));
        least = glm::min(least, along);
        most = glm::max(most, along);
      }
    }
  return {glm::dvec3(least), glm::dvec3(most)};
}

bool MovedSlab::is_still(const glm::dvec3& low, const glm::dvec3& high) const noexcept {
  const Cell first = cell_of(low), last = cell_of(high);
  for (int j = first.at.y; j <= last.at.y + 1; ++j)
    for (int i = first.at.x; i <= last.at.x + 1; ++i) {
      const glm::vec4* const nodes = column(i, j);
      for (int l = first.at.z; l <= last.at.z + 1; ++l)
        if (nodes[l] != glm::vec4(0.0F)) return false;
    }
  return true;
}

MovedSlab::Between MovedSlab::between(double x_mm, double y_mm) const noexcept {
  const double x = within((x_mm - part_.low_mm.x) * per_step_.x, size_.x - 1.0),
               y = within((y_mm - part_.low_mm.y) * per_step_.y, size_.y - 1.0);
  const int i = std::min(static_cast<int>(x), size_.x - 2), j = std::min(static_cast<int>(y), size_.y - 2);
  return {i, j, static_cast<float>(x - i), static_cast<float>(y - j)};
}

}  // namespace seldinger::tissue
