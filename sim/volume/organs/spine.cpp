#include "sim/volume/organs/spine.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>

namespace seldinger::volume {

std::vector<glm::dvec2> middle_of_back(const OrganGrid& grid) {
  constexpr double kAsideMm = 40.0;
  constexpr int kAround = 8;
  const Lattice lattice(grid.volume.size_voxels);
  const glm::ivec3& n = lattice.size();
  std::vector<glm::dvec3> sums(static_cast<std::size_t>(n.z));  // x, y, count
  for (int k = 0; k < n.z; ++k) {
    glm::ivec2 low(n.x, n.y), high(-1);
    double middle = 0.0, count = 0.0;
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i < n.x; ++i)
        if (grid.body[lattice.at({i, j, k})] != 0) {
          low = glm::min(low, glm::ivec2(i, j)), high = glm::max(high, glm::ivec2(i, j));
          middle += i, count += 1.0;
        }
    if (count == 0.0) continue;
    middle /= count;
    for (int j = (low.y + high.y) / 2; j <= high.y; ++j)
      for (int i = low.x; i <= high.x; ++i)
        if (grid.bone[lattice.at({i, j, k})] != 0 && std::abs(i - middle) * kOrganGridMm <= kAsideMm)
          sums[static_cast<std::size_t>(k)] += glm::dvec3(i, j, 1);
  }
  std::vector<std::optional<glm::dvec2>> found(sums.size());
  for (int k = 0; k < n.z; ++k) {
    glm::dvec3 sum(0.0);
    for (int z = std::max(0, k - kAround); z <= std::min(n.z - 1, k + kAround); ++z)
      sum += sums[static_cast<std::size_t>(z)];
    if (sum.z > 0.0) found[static_cast<std::size_t>(k)] = glm::dvec2(sum) / sum.z * kOrganGridMm;
  }
  for (std::size_t k = 1; k < found.size(); ++k)
    if (!found[k]) found[k] = found[k - 1];
  for (std::size_t k = found.size(); k-- > 1;)
    if (!found[k - 1]) found[k - 1] = found[k];
  std::vector<glm::dvec2> made;
  for (const auto& one : found)
    if (one) made.push_back(*one);
  return made;
}

Spine find_spine(const OrganGrid& grid, const std::vector<glm::dvec2>& middle_mm) {
  constexpr double kThickMm = 6.0;  // half of what the least body of an adult's neck measures, 12 to 14 mm
  constexpr double kAsideMm =
      20.0;  // and 6 mm more are 55 mm across, a wide lumbar body; hip bones lie farther aside
  constexpr double kAheadMm = 45.0, kBehindMm = 30.0;
  constexpr int kAround = 5;  // 15 mm: more than a disc
  const Lattice lattice(grid.volume.size_voxels);
  const glm::ivec3 n = lattice.size();
  const auto is_thick = [&](const glm::ivec3& p) {
    constexpr int kThick = static_cast<int>(kThickMm / kOrganGridMm);
    for (int y = -kThick; y <= kThick; ++y)
      for (int x = -kThick; x <= kThick; ++x) {
        const glm::ivec3 q = p + glm::ivec3(x, y, 0);
        if (x * x + y * y <= kThick * kThick && (!lattice.holds(q) || grid.bone[lattice.at(q)] == 0)) return false;
      }
    return true;
  };
  std::vector<std::vector<glm::dvec2>> blocks(static_cast<std::size_t>(n.z));
  for (std::size_t at = 0; at < grid.bone.size(); ++at) {
    const glm::ivec3 p = lattice.place(at);
    if (!is_thick(p)) continue;
    const glm::dvec2 mm = glm::dvec2(p) * kOrganGridMm, off_mm = mm - middle_mm[static_cast<std::size_t>(p.z)];
    if (std::abs(off_mm.x) <= kAsideMm && off_mm.y >= -kAheadMm && off_mm.y <= kBehindMm)
      blocks[static_cast<std::size_t>(p.z)].push_back(mm);
  }
  Spine made;
  made.bodies.resize(blocks.size());
  for (int k = 0; k < n.z; ++k) {
    glm::dvec2 sum(0.0), low(1e9), high(-1e9);
    double count = 0.0;
    for (int z = std::max(0, k - kAround); z <= std::min(n.z - 1, k + kAround); ++z)
      for (const glm::dvec2& mm : blocks[static_cast<std::size_t>(z)]) {
        sum += mm, count += 1.0;
        low = glm::min(low, mm), high = glm::max(high, mm);
      }
    if (count == 0.0) continue;
    const glm::dvec2 half_mm = (high - low) / 2.0 + kThickMm + kOrganGridMm / 2.0;
    made.bodies[static_cast<std::size_t>(k)] = {sum / count, half_mm.x, half_mm.y};
  }
  // The longest run of slices alone.
  int best_begin = 0, best_end = 0;
  for (int begin = 0, k = 0; k <= n.z; ++k) {
    if (k < n.z && made.bodies[static_cast<std::size_t>(k)]) continue;
    if (k - begin > best_end - best_begin) best_begin = begin, best_end = k;
    begin = k + 1;
  }
  for (int k = 0; k < n.z; ++k) {
    if (k < best_begin || k >= best_end)
      made.bodies[static_cast<std::size_t>(k)].reset();
    else if (!blocks[static_cast<std::size_t>(k)].empty())
      made.seen_share += 1.0 / (best_end - best_begin);
  }
  return made;
}

}  // namespace seldinger::volume
