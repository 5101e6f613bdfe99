#include "sim/imaging/xray/contrast.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>
#include <utility>

#include "sim/base/check.h"

namespace seldinger::imaging {
namespace {

constexpr std::int16_t kNoContrastHu = -1000;

struct VoxelBox {
  glm::ivec3 low, high;  // inclusive; empty where low > high
};

glm::ivec3 voxel_at(std::uint32_t number, const glm::ivec3& size) {
  const auto row = static_cast<std::uint32_t>(size.x), slice = row * static_cast<std::uint32_t>(size.y);
  return {static_cast<int>(number % row), static_cast<int>(number % slice / row), static_cast<int>(number / slice)};
}

// How many voxels, from the first on, hold so much; the last of them may be filled in part.
std::span<const std::uint32_t> first_of(const std::vector<std::uint32_t>& voxels, double ml, double voxel_ml) {
  const auto count = static_cast<std::size_t>(std::ceil(ml / voxel_ml - 1e-9));
  return {voxels.data(), std::min(count, voxels.size())};
}

}  // namespace

ContrastMedium::ContrastMedium(const volume::Volume& patient, tissue::Lumens lumens)
    : patient_(patient), lumens_(std::move(lumens)) {}

// Tissue's voxels about a place by their distance, enough for so much.
std::vector<std::uint32_t> ContrastMedium::depot_order(const glm::dvec3& at_lps_mm, double ml) const {
  constexpr double kMm3PerMl = 1000.0;
  const double radius_mm =
      std::cbrt(kMm3PerMl * ml * 3.0 / (4.0 * std::numbers::pi)) + glm::length(patient_.spacing_mm);
  const glm::dvec3 middle(volume::voxel_from_lps(patient_) * glm::dvec4(at_lps_mm, 1.0));
  const glm::dvec3 reach = radius_mm / patient_.spacing_mm, last(patient_.size_voxels - 1);
  const glm::ivec3 low(glm::clamp(glm::floor(middle - reach), glm::dvec3(0.0), last));
  const glm::ivec3 high(glm::clamp(glm::ceil(middle + reach), glm::dvec3(0.0), last));
  std::vector<std::pair<double, std::uint32_t>> found;
  for (int k = low.z; k <= high.z; ++k)
    for (int j = low.y; j <= high.y; ++j)
      for (int i = low.x; i <= high.x; ++i) {
        const double mm = glm::length((glm::dvec3(i, j, k) - middle) * patient_.spacing_mm);
        if (mm <= radius_mm) found.emplace_back(mm, static_cast<std::uint32_t>(patient_.index(i, j, k)));
      }
  std::sort(found.begin(), found.end());
  std::vector<std::uint32_t> order;
  for (const auto& [mm, voxel] : found) order.push_back(voxel);
  return order;
}

const std::vector<std::uint32_t>& ContrastMedium::order_of(const cases::ContrastPool& pool, Order& order) const {
  const bool same = order.lumen == pool.lumen && order.at_rest_lps_mm == pool.at_rest_lps_mm;
  const tissue::Lumen* lumen = lumens_.find(pool.lumen);
  if (!same || order.voxels.empty() ||
      (lumen == nullptr && lumens_.voxel_ml() * static_cast<double>(order.voxels.size()) < pool.spread_ml)) {
    constexpr double kAheadMl = 5.0;  // a depot grows on
    order = {pool.lumen, pool.at_rest_lps_mm,
             lumen != nullptr ? lumens_.filling_order(*lumen, pool.at_rest_lps_mm)
                              : depot_order(pool.at_rest_lps_mm, pool.spread_ml + kAheadMl)};
  }
  return order.voxels;
}

bool ContrastMedium::take(const cases::NeedleFlow& flow) {
  const bool any = std::any_of(flow.pools.begin(), flow.pools.end(),
                               [](const cases::ContrastPool& pool) { return pool.contrast_ml > 0.0; });
  if (!any || flow.pools == taken_) return any;
  taken_ = flow.pools;
  std::array<std::span<const std::uint32_t>, cases::kContrastPools> filled;
  VoxelBox box{patient_.size_voxels, glm::ivec3(-1)};
  for (std::size_t i = 0; i < flow.pools.size(); ++i) {
    const cases::ContrastPool& pool = flow.pools[i];
    if (!(pool.contrast_ml > 0.0)) continue;
    filled[i] = first_of(order_of(pool, orders_[i]), pool.spread_ml, lumens_.voxel_ml());
    for (const std::uint32_t voxel : filled[i]) {
      box.low = glm::min(box.low, voxel_at(voxel, patient_.size_voxels));
      box.high = glm::max(box.high, voxel_at(voxel, patient_.size_voxels));
    }
  }
  box.low -= 1;
  box.high += 1;
  volume_.size_voxels = box.high - box.low + 1;
  volume_.spacing_mm = patient_.spacing_mm;
  volume_.lps_from_voxel = patient_.lps_from_voxel;
  volume_.lps_from_voxel[3] = patient_.lps_from_voxel * glm::dvec4(glm::dvec3(box.low), 1.0);
  volume_.hu.assign(static_cast<std::size_t>(volume_.size_voxels.x) *
                        static_cast<std::size_t>(volume_.size_voxels.y) *
                        static_cast<std::size_t>(volume_.size_voxels.z),
                    kNoContrastHu);
  for (std::size_t i = 0; i < filled.size(); ++i) {
    double left = flow.pools[i].spread_ml / lumens_.voxel_ml();  // in voxels
    for (const std::uint32_t voxel : filled[i]) {
      const glm::ivec3 at = voxel_at(voxel, patient_.size_voxels) - box.low;
      const double more = 1000.0 * cases::concentration(flow.pools[i]) * std::min(1.0, left);
      std::int16_t& hu = volume_.hu[volume_.index(at.x, at.y, at.z)];
      hu = static_cast<std::int16_t>(std::min(0.0, std::round(hu + more)));
      left -= 1.0;
    }
  }
  return true;
}

std::vector<float> ContrastMedium::lengths_mm(const XrayGeometry& geometry,
                                              const tissue::Displacement& displacement, int threads) {
  CHECK(volume_.hu.size() > 1);
  const CpuOptions options{.threads = threads};
  moved_.reset();
  if (tissue::count_sources(displacement) == 0)
    return XrayCpu(volume_).project(geometry, ProjectionMethod::exact, options).water_mm;
  moved_.emplace(volume_);
  moved_->move(displacement, geometry);
  return moved_->projector().project(geometry, ProjectionMethod::exact, options).water_mm;
}

}  // namespace seldinger::imaging
