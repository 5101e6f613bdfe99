#include "sim/volume/organs/chest.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace seldinger::volume {
namespace {

int median_hu(const OrganGrid& grid, const Voxels& voxels) {
  std::vector<std::int16_t> hu;
  hu.reserve(voxels.size());
  for (const std::size_t at : voxels) hu.push_back(grid.volume.hu[at]);
  const auto middle = hu.begin() + static_cast<std::ptrdiff_t>(hu.size() / 2);
  std::nth_element(hu.begin(), middle, hu.end());
  return *middle;
}

Part part_of(const OrganGrid& grid, FoundOrgan organ, double confidence, Voxels voxels) {
  return {{organ, std::clamp(confidence, 0.0, 1.0), ml_of(voxels.size()), median_hu(grid, voxels)},
          std::move(voxels)};
}

// What is a vertebra and no rib's head: bone no wider than the body at its height.
constexpr double kArchBehindMm = 65.0;
bool in_vertebra(const VertebralBody& body, const glm::dvec2& off_mm) {
  return std::abs(off_mm.x) <= body.half_width_mm && off_mm.y >= -body.half_depth_mm && off_mm.y <= kArchBehindMm;
}

}  // namespace

std::vector<Part> find_lungs(const OrganGrid& grid, const std::vector<glm::dvec2>& middle_mm) {
  // Where both meet they do so in a thin sheet. Lung is neither gas nor a mixture of it with what bowel holds.
  constexpr double kSheetMm = 6.0, kLeastCoreMl = 5.0, kLeastMl = 30.0;
  constexpr int kLowestHu = -950, kHighestHu = -500;
  constexpr double kHardlyEven = 0.6;
  const Lattice lattice(grid.volume.size_voxels);
  const Mask inner = lattice.eroded(grid.lung, kSheetMm);
  Mask side(grid.lung.size(), 0);  // 1 right, 2 left
  std::array<double, 3> all{}, other_side{}, even{};
  for (const Voxels& core : lattice.pieces(inner)) {
    if (ml_of(core.size()) < kLeastCoreMl) continue;
    double right = 0.0, like_lung = 0.0;
    for (const std::size_t at : core) {
      const glm::ivec3 p = lattice.place(at);
      right += p.x * kOrganGridMm < middle_mm[static_cast<std::size_t>(p.z)].x ? 1.0 : 0.0;
      like_lung += grid.volume.hu[at] >= kLowestHu && grid.volume.hu[at] <= kHighestHu ? 1.0 : 0.0;
    }
    const auto voxels = static_cast<double>(core.size());
    const std::size_t which = right * 2.0 > voxels ? 1 : 2;
    for (const std::size_t at : core) side[at] = static_cast<std::uint8_t>(which);
    all[which] += voxels, even[which] += like_lung;
    other_side[which] += which == 1 ? voxels - right : right;
  }
  lattice.spread(grid.lung, static_cast<int>(2.0 * kSheetMm / kOrganGridMm), side);
  std::vector<Part> made;
  for (const auto& [which, organ] : {std::pair(1, FoundOrgan::right_lung), std::pair(2, FoundOrgan::left_lung)}) {
    Voxels voxels;
    for (std::size_t at = 0; at < side.size(); ++at)
      if (side[at] == which) voxels.push_back(at);
    if (ml_of(voxels.size()) < kLeastMl) continue;
    const auto i = static_cast<std::size_t>(which);
    const double likely = (even[i] / all[i] - kHardlyEven) / (1.0 - kHardlyEven);
    made.push_back(part_of(grid, organ, likely * (1.0 - 2.0 * other_side[i] / all[i]), std::move(voxels)));
  }
  return made;
}

std::vector<Part> find_vertebrae(const OrganGrid& grid, const Spine& spine) {
  constexpr double kLeastMl = 5.0;
  const Lattice lattice(grid.volume.size_voxels);
  Voxels voxels;
  for (std::size_t at = 0; at < grid.bone.size(); ++at) {
    if (grid.bone[at] == 0) continue;
    const glm::ivec3 p = lattice.place(at);
    const auto& body = spine.bodies[static_cast<std::size_t>(p.z)];
    if (body && in_vertebra(*body, glm::dvec2(p) * kOrganGridMm - body->centre_mm)) voxels.push_back(at);
  }
  if (ml_of(voxels.size()) < kLeastMl) return {};
  return {part_of(grid, FoundOrgan::vertebrae, spine.seen_share, std::move(voxels))};
}

std::vector<Part> find_ribs(const OrganGrid& grid, const Spine& spine, const std::vector<Part>& lungs) {
  // A rib is 12 mm thick at most; over it lie muscles, and only then the shoulder blade. Beside a vertebra, what is
  // its transverse process and what a rib's head is not told apart.
  constexpr double kOnLungMm = 15.0, kSternumHalfMm = 35.0, kProcessMm = 42.0;
  constexpr double kLeastMl = 0.3, kLeastOnLung = 0.5;
  const Lattice lattice(grid.volume.size_voxels);
  Mask on_lung(grid.bone.size(), 0);
  const Mask everywhere(grid.bone.size(), 1);
  for (const Part& lung : lungs)
    if (lung.found.confidence >= kOrganConfidence)
      for (const std::size_t at : lung.voxels) on_lung[at] = 1;
  lattice.spread(everywhere, static_cast<int>(kOnLungMm / kOrganGridMm), on_lung);
  Mask rest = grid.bone;
  for (std::size_t at = 0; at < rest.size(); ++at) {
    if (rest[at] == 0) continue;
    const glm::ivec3 p = lattice.place(at);
    const auto& body = spine.bodies[static_cast<std::size_t>(p.z)];
    if (!body) {  // nothing to tell the spine and the breastbone by
      rest[at] = 0;
      continue;
    }
    const glm::dvec2 off_mm = glm::dvec2(p) * kOrganGridMm - body->centre_mm;
    const bool process = std::abs(off_mm.x) <= kProcessMm && off_mm.y >= -body->half_depth_mm,
               sternum = std::abs(off_mm.x) <= kSternumHalfMm && off_mm.y < -body->half_depth_mm - kSternumHalfMm;
    if (process || sternum) rest[at] = 0;
  }
  Voxels voxels;
  double near = 0.0;
  for (const Voxels& piece : lattice.pieces(rest)) {
    if (ml_of(piece.size()) < kLeastMl) continue;
    const auto on = static_cast<double>(
        std::count_if(piece.begin(), piece.end(), [&](std::size_t at) { return on_lung[at] != 0; }));
    if (on < kLeastOnLung * static_cast<double>(piece.size())) continue;
    near += on;
    voxels.insert(voxels.end(), piece.begin(), piece.end());
  }
  if (voxels.empty()) return {};
  const double on_lung_share = near / static_cast<double>(voxels.size());
  return {part_of(grid, FoundOrgan::ribs, on_lung_share, std::move(voxels))};
}

}  // namespace seldinger::volume
