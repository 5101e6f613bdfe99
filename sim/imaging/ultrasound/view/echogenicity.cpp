#include "sim/imaging/ultrasound/view/echogenicity.h"

#include <algorithm>
#include <cmath>

#include "sim/base/check.h"
#include "sim/base/rows.h"
#include "sim/imaging/ultrasound/view/tissue.h"

namespace seldinger::imaging {
namespace {

using volume::TissueClass;
constexpr double kSmoothMm = 2.0;  // noise of a voxel is averaged over this to each side
constexpr double kBlockMm = 4.0;   // surroundings are known by blocks of this size
constexpr int kAroundBlocks = 3;   // to each side: 28 mm, wider than vessels, narrower than organs
constexpr double kLeastHu = -20.0, kMostHu = 250.0;  // clamped: a clip does not darken what lies beside it

bool is_parenchyma(TissueClass tissue) {
  return tissue == TissueClass::soft_tissue || tissue == TissueClass::vessel ||
         (tissue >= TissueClass::liver && tissue <= TissueClass::muscle);
}

struct Sum {
  std::int64_t hu = 0, count = 0;
};

// Mean HU of parenchyma in blocks, and of the blocks around them.
class Surroundings {
 public:
  Surroundings(const volume::Volume& volume, std::span<const TissueClass> classes, int threads)
      : block_(glm::max(glm::ivec3(glm::round(kBlockMm / volume.spacing_mm)), glm::ivec3(1))),
        size_((volume.size_voxels + block_ - 1) / block_),
        mean_(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) *
              static_cast<std::size_t>(size_.z)) {
    std::vector<Sum> sums(mean_.size());
    base::over_rows(size_.z, threads, [&](int z) {
      for (int k = z * block_.z; k < std::min((z + 1) * block_.z, volume.size_voxels.z); ++k)
        for (int j = 0; j < volume.size_voxels.y; ++j)
          for (int i = 0; i < volume.size_voxels.x; ++i) {
            const auto at = static_cast<std::size_t>(volume.index(i, j, k));
            if (!is_parenchyma(classes[at])) continue;
            Sum& sum = sums[index(i / block_.x, j / block_.y, z)];
            sum.hu += std::clamp<int>(volume.hu[at], static_cast<int>(kLeastHu), static_cast<int>(kMostHu));
            ++sum.count;
          }
    });
    for (int axis = 0; axis < 3; ++axis) spread(sums, axis);
    for (std::size_t i = 0; i < sums.size(); ++i)
      mean_[i] = sums[i].count > 0 ? static_cast<float>(sums[i].hu) / static_cast<float>(sums[i].count) : 0.0F;
  }
  double mean_hu(int i, int j, int k) const {
    return static_cast<double>(mean_[index(i / block_.x, j / block_.y, k / block_.z)]);
  }

 private:
  std::size_t index(int x, int y, int z) const {
    return static_cast<std::size_t>(x) +
           static_cast<std::size_t>(size_.x) *
               (static_cast<std::size_t>(y) + static_cast<std::size_t>(size_.y) * static_cast<std::size_t>(z));
  }
  // Each block becomes the sum of those to both sides along one axis.
  void spread(std::vector<Sum>& sums, int axis) const {
    const std::vector<Sum> from = sums;
    glm::ivec3 at;
    for (at.z = 0; at.z < size_.z; ++at.z)
      for (at.y = 0; at.y < size_.y; ++at.y)
        for (at.x = 0; at.x < size_.x; ++at.x) {
          Sum sum;
          glm::ivec3 other = at;
          const int low = std::max(0, at[axis] - kAroundBlocks),
                    high = std::min(size_[axis] - 1, at[axis] + kAroundBlocks);
          for (other[axis] = low; other[axis] <= high; ++other[axis]) {
            const Sum& one = from[index(other.x, other.y, other.z)];
            sum.hu += one.hu;
            sum.count += one.count;
          }
          sums[index(at.x, at.y, at.z)] = sum;
        }
  }

  glm::ivec3 block_, size_;
  std::vector<float> mean_;
};

// Mean HU of the parenchyma about each voxel of one slice. Sums are of whole numbers, so that a sum along each axis
// in turn, each from the one before it, is that of the box: three steps a voxel where a box has some hundred.
class Smoothed {
 public:
  Smoothed(const volume::Volume& volume, std::span<const TissueClass> classes)
      : volume_(volume),
        classes_(classes),
        reach_(glm::floor(kSmoothMm / volume.spacing_mm + 0.5)),
        sums_(static_cast<std::size_t>(volume.size_voxels.x) * static_cast<std::size_t>(volume.size_voxels.y)),
        line_(static_cast<std::size_t>(std::max(volume.size_voxels.x, volume.size_voxels.y))) {}

  void take(int k) {
    const glm::ivec3 n = volume_.size_voxels;
    std::fill(sums_.begin(), sums_.end(), Sum{});
    for (int z = std::max(0, k - reach_.z); z <= std::min(n.z - 1, k + reach_.z); ++z) {
      const auto first = static_cast<std::size_t>(volume_.index(0, 0, z));
      for (std::size_t i = 0; i < sums_.size(); ++i) {
        if (!is_parenchyma(classes_[first + i])) continue;
        sums_[i].hu += volume_.hu[first + i];
        ++sums_[i].count;
      }
    }
    const auto nx = static_cast<std::size_t>(n.x), ny = static_cast<std::size_t>(n.y);
    for (std::size_t j = 0; j < ny; ++j) along(j * nx, 1, nx, reach_.x);
    for (std::size_t i = 0; i < nx; ++i) along(i, nx, ny, reach_.y);
  }
  double mean_hu(int i, int j) const {
    const Sum& sum = sums_[static_cast<std::size_t>(i) +
                           static_cast<std::size_t>(volume_.size_voxels.x) * static_cast<std::size_t>(j)];
    return static_cast<double>(sum.hu) / static_cast<double>(sum.count);
  }

 private:
  void along(std::size_t first, std::size_t step, std::size_t count, int reach) {
    const auto far = static_cast<std::size_t>(reach);
    for (std::size_t i = 0; i < count; ++i) line_[i] = sums_[first + i * step];
    Sum sum;
    for (std::size_t i = 0; i < std::min(far, count); ++i) {
      sum.hu += line_[i].hu;
      sum.count += line_[i].count;
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (i + far < count) {
        sum.hu += line_[i + far].hu;
        sum.count += line_[i + far].count;
      }
      if (i > far) {
        sum.hu -= line_[i - far - 1].hu;
        sum.count -= line_[i - far - 1].count;
      }
      sums_[first + i * step] = sum;
    }
  }

  const volume::Volume& volume_;
  std::span<const TissueClass> classes_;
  glm::ivec3 reach_;
  std::vector<Sum> sums_, line_;
};

// Share of parenchyma's surroundings that are denser than plain CT knows.
bool is_enhanced(const volume::Volume& volume, std::span<const TissueClass> classes,
                 const Surroundings& surroundings) {
  std::size_t dense = 0, all = 0;
  for (int k = 0; k < volume.size_voxels.z; ++k)
    for (int j = 0; j < volume.size_voxels.y; j += 4)
      for (int i = 0; i < volume.size_voxels.x; i += 4)
        if (is_parenchyma(classes[static_cast<std::size_t>(volume.index(i, j, k))])) {
          ++all;
          if (surroundings.mean_hu(i, j, k) > kPlainMostHu) ++dense;
        }
  return static_cast<double>(dense) > kEnhancedShare * static_cast<double>(all);
}

double offset_db(double hu, double around_hu, bool enhanced) {
  // Parenchyma by its surroundings: plain liver 60, spleen 50, kidney 30; enhanced liver and spleen about 110,
  // kidney above 140, muscle 60.
  const double organ = enhanced ? (around_hu < 85.0 ? -2.0 : 2.0 - 0.1 * std::max(0.0, around_hu - 125.0))
                                : 0.3 * (around_hu - 50.0);
  const double apart = enhanced ? hu - around_hu : around_hu - hu;
  const double vessel = std::clamp((apart - kVesselFromHu) / (kVesselFullHu - kVesselFromHu), 0.0, 1.0);
  return std::clamp(organ, -7.0, 3.0) + vessel * kVesselDb;
}

}  // namespace

std::uint8_t echo_level(double over_liver_db, TissueClass tissue) {
  const double db = over_liver_db - acoustic_table()[static_cast<std::size_t>(tissue)].scatter_db;
  return static_cast<std::uint8_t>(std::clamp(std::lround(db / kEchoStepDb) + long{kNoEchoOffset}, 0L, 255L));
}

const std::array<float, 256>& echo_offset_amplitudes() {
  static const auto kTable = [] {
    std::array<float, 256> table;
    for (std::size_t i = 0; i < table.size(); ++i)
      table[i] = static_cast<float>(std::pow(10.0, echo_offset_db(static_cast<std::uint8_t>(i)) / 20.0));
    return table;
  }();
  return kTable;
}

std::vector<std::uint8_t> echogenicity(const volume::Volume& volume, std::span<const volume::TissueClass> classes,
                                       int threads) {
  CHECK(classes.size() == volume.hu.size());
  const Surroundings surroundings(volume, classes, threads);
  const bool enhanced = is_enhanced(volume, classes, surroundings);
  const glm::ivec3 n = volume.size_voxels;
  std::vector<std::uint8_t> levels(classes.size(), kNoEchoOffset);
  base::over_rows(
      n.z, threads, [&] { return Smoothed(volume, classes); },
      [&](int k, Smoothed& smoothed) {
        smoothed.take(k);
        for (int j = 0; j < n.y; ++j)
          for (int i = 0; i < n.x; ++i) {
            const auto at = static_cast<std::size_t>(volume.index(i, j, k));
            if (classes[at] != TissueClass::soft_tissue) continue;
            const double hu = std::clamp(smoothed.mean_hu(i, j), kLeastHu, kMostHu);
            const double db = offset_db(hu, surroundings.mean_hu(i, j, k), enhanced);
            levels[at] = static_cast<std::uint8_t>(kNoEchoOffset + static_cast<int>(std::lround(db / kEchoStepDb)));
          }
      });
  return levels;
}

}  // namespace seldinger::imaging
