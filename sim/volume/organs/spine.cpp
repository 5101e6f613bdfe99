#include "sim/volume/organs/spine.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>

namespace seldinger::volume {
namespace {

// Of a slice's body: the cells it spans, and those that touch the left and the right face of what was scanned.
struct Section {
  glm::ivec2 low, high{-1};
  double middle = 0.0, cells = 0.0, at_first = 0.0, at_last = 0.0;
};

Section section_of(const OrganGrid& grid, const Lattice& lattice, int k) {
  const glm::ivec3& n = lattice.size();
  Section made{.low = {n.x, n.y}};
  for (int j = 0; j < n.y; ++j)
    for (int i = 0; i < n.x; ++i) {
      if (grid.body[lattice.at({i, j, k})] == 0) continue;
      made.low = glm::min(made.low, glm::ivec2(i, j)), made.high = glm::max(made.high, glm::ivec2(i, j));
      made.middle += i, made.cells += 1.0;
      made.at_first += i == 0 ? 1.0 : 0.0;
      made.at_last += i == n.x - 1 ? 1.0 : 0.0;
    }
  if (made.cells > 0.0) made.middle /= made.cells;
  return made;
}

// Whether the middle of what is seen is the patient's: not where more of one side is cut off than of the other. A
// trunk is about an ellipse; where a face cuts it so and so high, so much of that half's width is left. Of a cut
// beyond the middle the same would be said: what is seen is then deeper than wide, and a trunk is not.
bool shows_its_middle(const Section& section) {
  constexpr double kMostUneven = 0.35;  // of the half width: the middle of what is seen is 30 mm off at most
  constexpr double kCut = 0.1;          // of the depth; less is a flank or an arm that touches
  const glm::dvec2 spans = glm::dvec2(section.high - section.low) + 1.0;
  const auto left = [&](double cut) { return std::sqrt(std::max(0.0, 1.0 - cut * cut)); };
  const double first = section.at_first / spans.y, last = section.at_last / spans.y;
  if (std::max(first, last) < kCut) return true;
  return spans.x >= spans.y && std::abs(left(first) - left(last)) <= kMostUneven;
}

// Where no more than a guess says where the middle is: puts it where the spine is. False where that is not proven:
// a long column, not cut itself, that goes along lung, which no bone of a leg does.
bool follow_spine(const OrganGrid& grid, std::vector<glm::dvec2>& middle_mm) {
  constexpr double kLeastMm = 100.0, kAlongLungMm = 20.0, kLeastSeen = 0.5, kOffCutMm = 30.0;
  if (middle_mm.empty()) return false;
  const Spine spine = find_spine(grid, middle_mm);
  const double width_mm = (grid.volume.size_voxels.x - 1) * kOrganGridMm;
  const auto in_slice = static_cast<std::ptrdiff_t>(grid.lung.size() / middle_mm.size());
  std::optional<double> last_mm;
  double long_mm = 0.0, along_lung_mm = 0.0;
  for (std::size_t k = 0; k < middle_mm.size(); ++k) {
    if (!spine.bodies[k]) continue;
    const double x_mm = spine.bodies[k]->centre_mm.x;
    if (x_mm < kOffCutMm || x_mm > width_mm - kOffCutMm) return false;
    const auto slice = grid.lung.begin() + static_cast<std::ptrdiff_t>(k) * in_slice;
    const bool beside_lung = std::find(slice, slice + in_slice, std::uint8_t{1}) != slice + in_slice;
    long_mm += kOrganGridMm;
    along_lung_mm += beside_lung ? kOrganGridMm : 0.0;
    if (!last_mm) last_mm = x_mm;  // of slices below the first
  }
  if (long_mm < kLeastMm || along_lung_mm < kAlongLungMm || spine.seen_share < kLeastSeen) return false;
  for (std::size_t k = 0; k < middle_mm.size(); ++k) {
    if (spine.bodies[k]) last_mm = spine.bodies[k]->centre_mm.x;
    middle_mm[k].x = *last_mm;
  }
  return true;
}

}  // namespace

std::vector<glm::dvec2> middle_of_back(const OrganGrid& grid) {
  constexpr double kAsideMm = 40.0;
  constexpr int kAround = 8;
  constexpr double kMostUnevenSlices = 0.25;  // two legs of which one is cut seem even
  const Lattice lattice(grid.volume.size_voxels);
  const glm::ivec3& n = lattice.size();
  std::vector<glm::dvec3> sums(static_cast<std::size_t>(n.z));  // x, y, count
  int of_body = 0, uneven = 0;
  for (int k = 0; k < n.z; ++k) {
    const Section section = section_of(grid, lattice, k);
    if (section.cells == 0.0) continue;
    ++of_body;
    uneven += shows_its_middle(section) ? 0 : 1;
    const glm::ivec2 &low = section.low, &high = section.high;
    for (int j = (low.y + high.y) / 2; j <= high.y; ++j)
      for (int i = low.x; i <= high.x; ++i)
        if (grid.bone[lattice.at({i, j, k})] != 0 && std::abs(i - section.middle) * kOrganGridMm <= kAsideMm)
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
  if (uneven > kMostUnevenSlices * of_body && !follow_spine(grid, made)) return {};
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
