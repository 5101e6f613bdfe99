#include "sim/volume/organs/gallbladder.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace seldinger::volume {
namespace {

// A gallbladder lies in a fossa of the liver: with a third of its surface or so on it, never within it, as a cyst
// does. A gut touches the liver with less, and holds gas.
constexpr double kLeastOnLiver = 0.15, kSureOnLiver = 0.3, kMostOnLiver = 0.75;
constexpr double kMostOnGas = 0.02, kMostOnKidney = 0.1;
constexpr double kBrighterHu = 25.0;  // than the liver: a kidney, also one that is not named, and its cysts' bed
constexpr int kSteps = 3;             // over its wall and a seam of fat, 9 mm
constexpr int kGasHu = -300;

struct Around {  // shares of its surface
  double liver = 0.0, kidney = 0.0, gas = 0.0;
};

enum class Beside : std::uint8_t { nothing, liver, kidney };

Around around(const OrganGrid& grid, const Part& one, const std::vector<Beside>& beside, int liver_hu) {
  const Lattice lattice(grid.volume.size_voxels);
  Voxels own = one.voxels;
  std::sort(own.begin(), own.end());
  double faces = 0.0;
  Around made;
  for (const std::size_t from : own)
    for (const glm::ivec3& way : kFaces) {
      glm::ivec3 q = lattice.place(from) + way;
      if (!lattice.holds(q) || std::binary_search(own.begin(), own.end(), lattice.at(q))) continue;
      faces += 1.0;
      bool liver = false, kidney = false, gas = false;
      for (int step = 0; step < kSteps && lattice.holds(q) && !liver; ++step, q += way) {
        liver = beside[lattice.at(q)] == Beside::liver;
        const bool bright = grid.soft[lattice.at(q)] != 0 && grid.level_hu[lattice.at(q)] > liver_hu + kBrighterHu;
        kidney |= !liver && (bright || beside[lattice.at(q)] == Beside::kidney);
        gas |= grid.body[lattice.at(q)] != 0 && grid.volume.hu[lattice.at(q)] < kGasHu;
      }
      made.liver += liver ? 1.0 : 0.0, made.kidney += kidney ? 1.0 : 0.0, made.gas += gas ? 1.0 : 0.0;
    }
  if (faces > 0.0) made.liver /= faces, made.kidney /= faces, made.gas /= faces;
  return made;
}

bool overlap(const Part& one, const Part& other) {
  return std::any_of(one.voxels.begin(), one.voxels.end(), [&](std::size_t at) {
    return std::find(other.voxels.begin(), other.voxels.end(), at) != other.voxels.end();
  });
}

}  // namespace

std::optional<Part> gallbladder_among(const OrganGrid& grid, std::vector<Part> candidates, const Part& liver,
                                      const std::vector<const Part*>& kidneys) {
  std::vector<Beside> beside(grid.soft.size(), Beside::nothing);
  for (const std::size_t at : liver.voxels) beside[at] = Beside::liver;
  for (const Part* kidney : kidneys)
    for (const std::size_t at : kidney->voxels) beside[at] = Beside::kidney;
  std::vector<Part> likely;
  for (Part& one : candidates) {
    const Around lies = around(grid, one, beside, liver.found.level_hu);
    if (lies.liver < kLeastOnLiver || lies.liver > kMostOnLiver || lies.gas > kMostOnGas ||
        lies.kidney > kMostOnKidney)
      continue;
    one.found.confidence *= std::min(1.0, lies.liver / kSureOnLiver);
    likely.push_back(std::move(one));
  }
  std::stable_sort(likely.begin(), likely.end(),
                   [](const Part& a, const Part& b) { return a.found.confidence > b.found.confidence; });
  if (likely.empty()) return std::nullopt;
  Part& best = likely.front();
  for (const Part& other : likely)
    if (!overlap(best, other)) {  // another like it, and neither is told from the other
      best.found.confidence -= other.found.confidence;
      break;
    }
  return std::move(best);
}

}  // namespace seldinger::volume
