// Lung, and gas that is none: told apart by size and by how dense the larger half of a connected space is.
#include <algorithm>
#include <cmath>

#include "sim/volume/components.h"
#include "sim/volume/tissue/class_steps.h"

namespace seldinger::volume {
namespace {

constexpr int kAirSpaceHu = -400;                     // the middle between lung (-850) and tissue (50)
constexpr int kDenserThanGas = -930;                  // lung is above: gas is -1000 to -950, lung -900 to -700
constexpr double kLungMl = 30.0, kLungShare = 0.003;  // a space smaller, or less of the body, is no lung
constexpr double kAirwayMl = 0.2, kAirwayEdgeMm = 2.5;

struct Space {
  std::size_t voxels = 0, inner = 0, denser = 0;  // denser: of the inner ones
};

double voxel_ml(const Volume& volume) {
  return volume.spacing_mm.x * volume.spacing_mm.y * volume.spacing_mm.z * 1e-3;
}

// Trachea and bronchi are joined to the lung, and as empty as bowel gas.
void mark_airways(const Volume& volume, std::vector<TissueClass>& classes) {
  const std::size_t slice_voxels =
      static_cast<std::size_t>(volume.size_voxels.x) * static_cast<std::size_t>(volume.size_voxels.y);
  std::vector<std::uint8_t> empty(classes.size(), 0);
  std::vector<std::int16_t> smooth;
  for (int k = 0; k < volume.size_voxels.z; ++k) {
    const std::size_t start = static_cast<std::size_t>(k) * slice_voxels;
    const auto first = classes.begin() + static_cast<std::ptrdiff_t>(start);
    if (std::find(first, first + static_cast<std::ptrdiff_t>(slice_voxels), TissueClass::lung) ==
        first + static_cast<std::ptrdiff_t>(slice_voxels))
      continue;
    smooth_slice(volume, k, smooth);
    for (std::size_t at = 0; at < slice_voxels; ++at)
      empty[start + at] = classes[start + at] == TissueClass::lung && smooth[at] < kDenserThanGas ? 1 : 0;
  }
  Components pieces(volume.size_voxels, empty);
  std::vector<std::size_t> voxels(pieces.numbers(), 0);
  pieces.each_run([&](std::size_t piece, std::size_t begin, std::size_t end) { voxels[piece] += end - begin; });
  pieces.each_run([&](std::size_t piece, std::size_t begin, std::size_t end) {
    if (static_cast<double>(voxels[piece]) * voxel_ml(volume) < kAirwayMl) return;
    for (std::size_t at = begin; at < end; ++at) classes[at] = TissueClass::gas;
  });
  // The airway's blurred edge is no lung either.
  const int steps = std::max(1, static_cast<int>(std::lround(kAirwayEdgeMm / volume.spacing_mm.x)));
  const auto row = static_cast<std::size_t>(volume.size_voxels.x);
  std::vector<std::size_t> reached, last;
  for (std::size_t at = 0; at < classes.size(); ++at)
    if (empty[at] != 0 && classes[at] == TissueClass::gas) last.push_back(at);
  for (int step = 0; step < steps; ++step, std::swap(last, reached)) {
    reached.clear();
    for (const std::size_t at : last)
      for (const std::size_t other : {at - 1, at + 1, at - row, at + row})
        if (other < classes.size() && classes[other] == TissueClass::lung) {
          classes[other] = TissueClass::gas;
          reached.push_back(other);
        }
  }
}

}  // namespace

void mark_air_spaces(const Volume& volume, std::vector<TissueClass>& classes) {
  std::vector<std::uint8_t> low(classes.size());
  std::size_t body = 0;
  for (std::size_t at = 0; at < classes.size(); ++at) {
    const bool inside = classes[at] != TissueClass::air;
    body += inside ? 1 : 0;
    low[at] = inside && volume.hu[at] < kAirSpaceHu ? 1 : 0;
  }
  const auto row = static_cast<std::size_t>(volume.size_voxels.x);
  Components pieces(volume.size_voxels, low);
  std::vector<Space> spaces(pieces.numbers());
  pieces.each_run([&](std::size_t piece, std::size_t begin, std::size_t end) {
    Space& space = spaces[piece];
    space.voxels += end - begin;
    for (std::size_t at = begin + 2; at + 2 < end; ++at) {
      // Two voxels from any edge in the slice, else a space of gas is dense by its rim.
      if (at < 2 * row || at + 2 * row >= low.size() || low[at - 2 * row] == 0 || low[at + 2 * row] == 0) continue;
      ++space.inner;
      space.denser += volume.hu[at] >= kDenserThanGas ? 1 : 0;
    }
  });
  const double lung_voxels = std::max(kLungMl / voxel_ml(volume), kLungShare * static_cast<double>(body));
  bool lung = false;
  pieces.each_run([&](std::size_t piece, std::size_t begin, std::size_t end) {
    const Space& space = spaces[piece];
    const bool is_lung = static_cast<double>(space.voxels) >= lung_voxels && space.denser * 3 > space.inner * 2;

    lung = lung || is_lung;
    for (std::size_t at = begin; at < end; ++at) classes[at] = is_lung ? TissueClass::lung : TissueClass::gas;
  });
  if (lung) mark_airways(volume, classes);
}

}  // namespace seldinger::volume
