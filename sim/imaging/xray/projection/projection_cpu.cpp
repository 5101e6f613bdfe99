#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "sim/base/check.h"
#include "sim/base/rows.h"
#include "sim/imaging/xray/projection/packet.h"
#include "sim/imaging/xray/projection/projection.h"

namespace seldinger::imaging {
namespace {

TileFunction tile_function(Instructions instructions) {
#if defined(__x86_64__)
  if (instructions == Instructions::avx512) return &project_tile_avx512;
  if (instructions == Instructions::avx2) return &project_tile_avx2;
#endif
  CHECK(instructions == Instructions::scalar);
  return &project_tile_scalar;
}

// Rays in the kept box's coordinates.
PacketView packet_view(const volume::Volume& volume, const PacketVolume& kept, const XrayGeometry& geometry) {
  const glm::dmat4 voxel_from_lps = volume::voxel_from_lps(volume);
  const auto place = [&](const glm::dvec3& p_lps_mm) {
    return glm::dvec3(voxel_from_lps * glm::dvec4(p_lps_mm, 1.0)) + 0.5 - glm::dvec3(kept.low);
  };
  const RaySegment first = ray_of(geometry, volume, 0, 0);
  const glm::dmat3 turn(voxel_from_lps);
  PacketView view;
  view.from = place(first.from_lps_mm);
  view.to = place(first.to_lps_mm);
  view.to_per_column = turn * (geometry.u * geometry.pixel_mm);
  view.to_per_row = turn * (geometry.v * geometry.pixel_mm);
  const bool parallel = !geometry.source_lps_mm;
  view.from_per_column = parallel ? view.to_per_column : glm::dvec3(0.0);
  view.from_per_row = parallel ? view.to_per_row : glm::dvec3(0.0);
  view.mm_from_voxel = glm::dmat3(volume.lps_from_voxel);
  view.width_px = geometry.width_px;
  view.height_px = geometry.height_px;
  return view;
}

struct Rectangle {
  int left = 0, top = 0, right = 0, bottom = 0;  // pixels; right and bottom excluded
};

// Pixels whose rays can meet the kept box: where its corners are seen. All of them where a corner is not seen.
Rectangle shadow(const PacketVolume& kept, const volume::Volume& volume, const XrayGeometry& geometry) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const glm::dvec2 size(geometry.width_px, geometry.height_px);
  glm::dvec2 low(kInfinite), high(-kInfinite);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 face = glm::dvec3(kept.low) - 0.5 +
                            glm::dvec3(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1) * glm::dvec3(kept.size);
    const auto pixel = pixel_of(geometry, glm::dvec3(volume.lps_from_voxel * glm::dvec4(face, 1.0)));
    if (!pixel) return {0, 0, geometry.width_px, geometry.height_px};
    low = glm::min(low, *pixel);
    high = glm::max(high, *pixel);
  }
  const glm::ivec2 first(glm::clamp(glm::floor(low) - 1.0, glm::dvec2(0.0), size));
  const glm::ivec2 end(glm::clamp(glm::ceil(high) + 2.0, glm::dvec2(0.0), size));
  return {first.x, first.y, end.x, end.y};
}

}  // namespace

Instructions best_instructions() noexcept {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
    return Instructions::avx512;
  if (__builtin_cpu_supports("avx2")) return Instructions::avx2;
#endif
  return Instructions::scalar;
}

struct XrayCpu::Parts {
  explicit Parts(const volume::Volume& v) : volume(v), kept(v) {}
  const volume::Volume& volume;
  PacketVolume kept;
};

XrayCpu::XrayCpu(const volume::Volume& volume) : parts_(std::make_unique<Parts>(volume)) {}
XrayCpu::~XrayCpu() = default;
XrayCpu::XrayCpu(XrayCpu&&) noexcept = default;

std::size_t XrayCpu::bytes() const noexcept {
  return parts_->kept.bytes();
}

PathLengths XrayCpu::project(const XrayGeometry& geometry, ProjectionMethod method,
                             const CpuOptions& options) const {
  CHECK(check_geometry(geometry).has_value());
  const std::size_t pixels =
      static_cast<std::size_t>(geometry.width_px) * static_cast<std::size_t>(geometry.height_px);
  const bool mineral = options.basis == Basis::water_and_mineral;
  PathLengths lengths{geometry.width_px, geometry.height_px, std::vector<float>(pixels), {}, {}};
  if (mineral) lengths.mineral_mm.resize(pixels);
  const PacketVolume& kept = parts_->kept;
  const volume::Volume& volume = parts_->volume;
  if (kept.size.x == 0) return lengths;
  if (method == ProjectionMethod::trilinear) {
    base::over_rows(geometry.height_px, options.threads, [&](int row) {
      for (int column = 0; column < geometry.width_px; ++column) {
        const RaySegment ray = ray_of(geometry, volume, column, row);
        const RayLengths one = lengths_between(volume, ray.from_lps_mm, ray.to_lps_mm, method);
        const std::size_t i = static_cast<std::size_t>(row) * static_cast<std::size_t>(geometry.width_px) +
                              static_cast<std::size_t>(column);
        lengths.water_mm[i] = static_cast<float>(mineral ? one.water_mm : one.total_mm());
        if (mineral) lengths.mineral_mm[i] = static_cast<float>(one.mineral_mm);
      }
    });
    return lengths;
  }
  const PacketView view = packet_view(volume, kept, geometry);
  const PacketJob job{&kept, &view, lengths.water_mm.data(), mineral ? lengths.mineral_mm.data() : nullptr,
                      method == ProjectionMethod::slab};
  const TileFunction tile = tile_function(options.instructions);
  const Rectangle part = shadow(kept, volume, geometry);
  const int left = part.left / kTilePx, top = part.top / kTilePx;
  const int columns = std::max(0, (part.right + kTilePx - 1) / kTilePx - left);
  const int rows = std::max(0, (part.bottom + kTilePx - 1) / kTilePx - top);
  base::over_rows(columns * rows, options.threads,
                  [&](int i) { tile(job, (left + i % columns) * kTilePx, (top + i / columns) * kTilePx); });
  return lengths;
}

}  // namespace seldinger::imaging
