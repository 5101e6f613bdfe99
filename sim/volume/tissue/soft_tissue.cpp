// Fat, fluid and the rest by HU without noise, averaged among neighbours that are soft too: an edge to gas or bone
// does not become fat or fluid.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "sim/volume/axial_slices.h"
#include "sim/volume/components.h"
#include "sim/volume/tissue/class_steps.h"

namespace seldinger::volume {
namespace {

constexpr int kLowestSoftHu = -200, kHighestSoftHu = 200;
constexpr int kFatBelowHu = -30;                        // the middle between fat, -100, and tissue, 40
constexpr int kFluidFromHu = -20, kFluidToHu = 18;      // bile and urine are 0 to 15
constexpr double kFluidRadiusMm = 3.0, kFluidMl = 1.0;  // an edge of fat and tissue has these HU, but is thinner
constexpr int kFluidEdgeHu = 28;
constexpr double kEvenNoise = 1.6, kEvenHu = 8.0;  // sd of HU in fluid: fat mixed with tissue has 50
constexpr double kNoisySdHu = 15.0;  // from here on the average goes over 5 x 5 voxels instead of 3 x 3
constexpr int kLeastFatHu = -160;    // two of its sd below the fattest
constexpr int kRimSteps = 4;
constexpr double kWideMm = 2.5;  // but never farther than this

// Sums of a box of 2 radius + 1 voxels, beyond the slice nothing.
class BoxSum {
 public:
  BoxSum(int width, int height, glm::ivec2 radius) : width_(width), height_(height), radius_(radius) {}

  void sum(const std::vector<int>& in, std::vector<int>& out) {
    const auto w = static_cast<std::size_t>(width_);
    rows_.resize(in.size());
    out.resize(in.size());
    for (int y = 0; y < height_; ++y) {
      const int* from = in.data() + static_cast<std::size_t>(y) * w;
      int* to = rows_.data() + static_cast<std::size_t>(y) * w;
      int running = 0;
      for (int x = 0; x < std::min(radius_.x, width_); ++x) running += from[x];
      for (int x = 0; x < width_; ++x) {
        if (x + radius_.x < width_) running += from[x + radius_.x];
        if (x - radius_.x - 1 >= 0) running -= from[x - radius_.x - 1];
        to[x] = running;
      }
    }
    column_.assign(w, 0);
    const auto add = [&](int y, int sign) {
      const int* row = rows_.data() + static_cast<std::size_t>(y) * w;
      for (std::size_t x = 0; x < w; ++x) column_[x] += sign * row[x];
    };
    for (int y = 0; y < std::min(radius_.y, height_); ++y) add(y, 1);
    for (int y = 0; y < height_; ++y) {
      if (y + radius_.y < height_) add(y + radius_.y, 1);
      if (y - radius_.y - 1 >= 0) add(y - radius_.y - 1, -1);
      std::copy(column_.begin(), column_.end(), out.begin() + static_cast<std::ptrdiff_t>(y) * width_);
    }
  }

 private:
  int width_, height_;
  glm::ivec2 radius_;
  std::vector<int> rows_, column_;
};

bool hollow(TissueClass tissue) {
  return tissue == TissueClass::air || tissue == TissueClass::gas || tissue == TissueClass::lung;
}

// At the edge of gas or lung a voxel holds part of both: what seems fat there and has too little HU, or has tissue
// behind it, is tissue.
void clear_false_rims(const Volume& volume, std::vector<TissueClass>& classes) {
  const glm::ivec3 n = volume.size_voxels;
  const auto row = static_cast<std::size_t>(n.x);
  std::vector<std::size_t> front;  // fat beside gas
  for (int k = 0; k < n.z; ++k)
    for (int j = 1; j + 1 < n.y; ++j) {
      const std::size_t start = volume.index(0, j, k);
      for (std::size_t at = start + 1; at + 1 < start + row; ++at)
        if (classes[at] == TissueClass::fat && (hollow(classes[at - 1]) || hollow(classes[at + 1]) ||
                                                hollow(classes[at - row]) || hollow(classes[at + row])))
          front.push_back(at);
    }
  const auto inner = [&](std::size_t at) {
    const std::size_t i = at % row, j = at / row % static_cast<std::size_t>(n.y);
    return i > 0 && i + 1 < row && j > 0 && j + 1 < static_cast<std::size_t>(n.y);
  };
  std::vector<std::size_t> next;
  for (int step = 0; step < kRimSteps; ++step, std::swap(front, next)) {
    next.clear();
    std::vector<std::size_t> cleared;
    for (const std::size_t at : front) {
      if (classes[at] != TissueClass::fat || !inner(at)) continue;
      bool tissue = volume.hu[at] < kLeastFatHu;
      const auto tissue_behind = [&](std::ptrdiff_t way) {
        const TissueClass before = classes[at - static_cast<std::size_t>(way)];
        if (!hollow(before) && (step == 0 || before != TissueClass::soft_tissue)) return false;
        std::size_t behind = at + static_cast<std::size_t>(way);
        for (int far = 1; far < kRimSteps && classes[behind] == TissueClass::fat && inner(behind); ++far)
          behind += static_cast<std::size_t>(way);
        return classes[behind] == TissueClass::soft_tissue;
      };
      const auto down = static_cast<std::ptrdiff_t>(row);
      tissue = tissue || tissue_behind(1) || tissue_behind(-1) || tissue_behind(down) || tissue_behind(-down);
      if (tissue) cleared.push_back(at);
    }
    for (const std::size_t at : cleared) {
      classes[at] = TissueClass::soft_tissue;
      for (const std::size_t other : {at - 1, at + 1, at - row, at + row})
        if (classes[other] == TissueClass::fat) next.push_back(other);
    }
  }
}

}  // namespace

double noise_sd_hu(const Volume& volume, const std::vector<TissueClass>& classes, NoiseFrom from) {
  const auto step = static_cast<std::size_t>(from.apart);
  std::array<std::size_t, 512> count{};
  std::size_t pairs = 0;
  const auto width = static_cast<std::size_t>(volume.size_voxels.x);
  for (std::size_t at = 0; at + step < classes.size(); ++at) {
    if (at % width + step >= width || classes[at] != TissueClass::soft_tissue) continue;
    const int a = volume.hu[at], b = volume.hu[at + step];
    if (std::min(a, b) < kLowestSoftHu || std::max(a, b) > kHighestSoftHu) continue;
    ++count[static_cast<std::size_t>(std::abs(a - b))];
    ++pairs;
  }
  std::size_t below = 0;
  for (std::size_t hu = 0; hu < count.size(); ++hu)
    if (static_cast<double>(below += count[hu]) >= from.share * static_cast<double>(pairs))
      return static_cast<double>(hu) / from.in_sd;
  return 0.0;
}

void mark_soft_tissue(const Volume& volume, std::vector<TissueClass>& classes) {
  const glm::ivec3 n = volume.size_voxels;
  const std::size_t slice_voxels = static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y);
  const double noise_hu = noise_sd_hu(volume, classes);
  const int wanted = noise_hu >= kNoisySdHu ? 2 : 1;
  const auto even_hu2 = static_cast<int>(std::pow(kEvenNoise * noise_hu, 2.0) + kEvenHu * kEvenHu);
  glm::ivec2 average(1), wide(1), fluid(1);
  for (int axis = 0; axis < 2; ++axis) {
    average[axis] = std::clamp(static_cast<int>(kWideMm / volume.spacing_mm[axis]), 0, wanted);
    wide[axis] = std::clamp(static_cast<int>(kWideMm / volume.spacing_mm[axis]), 0, 2);
    fluid[axis] = std::max(1, static_cast<int>(std::lround(kFluidRadiusMm / volume.spacing_mm[axis])));
  }
  BoxSum box(n.x, n.y, average), wide_box(n.x, n.y, wide);
  std::vector<int> hu(slice_voxels), square(slice_voxels), one(slice_voxels), sum, count, squares, scratch;
  std::vector<std::uint8_t> opened(slice_voxels), fluids(classes.size(), 0);
  for (int k = 0; k < n.z; ++k) {
    const std::size_t start = static_cast<std::size_t>(k) * slice_voxels;
    TissueClass* const slice = classes.data() + start;
    for (std::size_t at = 0; at < slice_voxels; ++at) {
      const int value = volume.hu[start + at];
      const bool soft = slice[at] == TissueClass::soft_tissue && value >= kLowestSoftHu && value <= kHighestSoftHu;
      hu[at] = soft ? value : 0;
      square[at] = soft ? value * value : 0;
      one[at] = soft ? 1 : 0;
    }
    box.sum(hu, sum);
    box.sum(one, count);
    bool soft = false;
    for (std::size_t at = 0; at < slice_voxels; ++at) {
      if (slice[at] != TissueClass::soft_tissue) continue;
      soft = true;
      // Without a division.
      if (one[at] == 0 ? volume.hu[start + at] < kLowestSoftHu : sum[at] < kFatBelowHu * count[at])
        slice[at] = TissueClass::fat;
    }
    if (!soft) continue;

    if (average != wide) {
      wide_box.sum(hu, sum);
      wide_box.sum(one, count);
    }
    wide_box.sum(square, squares);
    bool any = false;
    for (std::size_t at = 0; at < slice_voxels; ++at) {
      opened[at] = slice[at] == TissueClass::soft_tissue && one[at] != 0 && sum[at] >= kFluidFromHu * count[at] &&
                           sum[at] <= kFluidToHu * count[at] &&
                           squares[at] - sum[at] / count[at] * sum[at] <= even_hu2 * count[at]
                       ? 1
                       : 0;
      any = any || opened[at] != 0;
    }
    if (!any) continue;
    grow_slice(opened, n.x, n.y, fluid, 0, scratch);
    grow_slice(opened, n.x, n.y, fluid + 1, 1, scratch);
    for (std::size_t at = 0; at < slice_voxels; ++at)
      fluids[start + at] = opened[at] != 0 && slice[at] == TissueClass::soft_tissue && one[at] != 0 &&
                                   sum[at] <= kFluidEdgeHu * count[at]
                               ? 1
                               : 0;
  }
  Components pieces(n, fluids);
  const double least = kFluidMl * 1e3 / (volume.spacing_mm.x * volume.spacing_mm.y * volume.spacing_mm.z);
  std::vector<std::size_t> voxels(pieces.numbers(), 0);
  pieces.each_run([&](std::size_t piece, std::size_t begin, std::size_t end) { voxels[piece] += end - begin; });
  pieces.each_run([&](std::size_t piece, std::size_t begin, std::size_t end) {
    if (static_cast<double>(voxels[piece]) < least) return;
    std::fill(classes.begin() + static_cast<std::ptrdiff_t>(begin),
              classes.begin() + static_cast<std::ptrdiff_t>(end), TissueClass::fluid);
  });
  clear_false_rims(volume, classes);
}

}  // namespace seldinger::volume
