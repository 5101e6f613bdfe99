#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <thread>

#include "sim/base/check.h"
#include "sim/imaging/xray/packet.h"
#include "sim/imaging/xray/projection.h"

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

// Pixels whose rays can meet the kept box: where its corners project. All of them where a corner is not in front of
// the source.
Rectangle shadow(const PacketVolume& kept, const volume::Volume& volume, const XrayGeometry& g) {
  const Rectangle all{0, 0, g.width_px, g.height_px};
  const glm::dvec3 normal = glm::cross(g.u, g.v);
  double low_c = std::numeric_limits<double>::infinity(), high_c = -low_c, low_r = low_c, high_r = -low_c;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 face = glm::dvec3(kept.low) - 0.5 +
                            glm::dvec3(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1) * glm::dvec3(kept.size);
    const glm::dvec3 p(volume.lps_from_voxel * glm::dvec4(face, 1.0));
    const glm::dvec3 ray = g.source_lps_mm ? p - *g.source_lps_mm : g.direction;
    const glm::dvec3 from = g.source_lps_mm ? *g.source_lps_mm : p;
    const double depth = glm::dot(ray, normal), distance = glm::dot(g.detector_center_lps_mm - from, normal);
    if (!(depth * distance > 1e-9 * distance * distance)) {
      if (g.source_lps_mm) return all;
    }
    const glm::dvec3 hit = from + ray * (distance / depth) - g.detector_center_lps_mm;
    const double c = glm::dot(hit, g.u) / g.pixel_mm + 0.5 * (g.width_px - 1);
    const double r = glm::dot(hit, g.v) / g.pixel_mm + 0.5 * (g.height_px - 1);
    low_c = std::min(low_c, c);
    high_c = std::max(high_c, c);
    low_r = std::min(low_r, r);
    high_r = std::max(high_r, r);
  }
  const auto clip = [](double x, int size) { return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(size))); };
  return {clip(std::floor(low_c) - 1.0, g.width_px), clip(std::floor(low_r) - 1.0, g.height_px),
          clip(std::ceil(high_c) + 2.0, g.width_px), clip(std::ceil(high_r) + 2.0, g.height_px)};
}

}  // namespace

Instructions best_instructions() noexcept {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vl"))
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
  return parts_->kept.values.size() * sizeof(std::uint16_t) +
         parts_->kept.occupied_before.size() * sizeof(std::int32_t);
}

PathLengths XrayCpu::project(const XrayGeometry& geometry, ProjectionMethod method, const CpuOptions& options) const {
  CHECK(check_geometry(geometry).has_value());
  CHECK(method != ProjectionMethod::trilinear);
  const std::size_t pixels = static_cast<std::size_t>(geometry.width_px) * static_cast<std::size_t>(geometry.height_px);
  const bool mineral = options.basis == Basis::water_and_mineral;
  PathLengths lengths{geometry.width_px, geometry.height_px, std::vector<float>(pixels), {}, {}};
  if (mineral) lengths.mineral_mm.resize(pixels);
  const PacketVolume& kept = parts_->kept;
  if (kept.size.x == 0) return lengths;
  const PacketView view = packet_view(parts_->volume, kept, geometry);
  const PacketJob job{&kept, &view, lengths.water_mm.data(), mineral ? lengths.mineral_mm.data() : nullptr,
                      method == ProjectionMethod::slab};
  const TileFunction tile = tile_function(options.instructions);
  const Rectangle part = shadow(kept, parts_->volume, geometry);
  const int left = part.left / kTilePx, top = part.top / kTilePx;
  const int columns = std::max(0, (part.right + kTilePx - 1) / kTilePx - left);
  const int rows = std::max(0, (part.bottom + kTilePx - 1) / kTilePx - top);
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int i = next.fetch_add(1); i < columns * rows; i = next.fetch_add(1))
      tile(job, (left + i % columns) * kTilePx, (top + i / columns) * kTilePx);
  };
  const int wanted = options.threads > 0 ? options.threads : static_cast<int>(std::thread::hardware_concurrency());
  const int threads = std::clamp(wanted, 1, std::max(1, columns * rows));
  std::vector<std::jthread> others;
  for (int i = 1; i < threads; ++i) others.emplace_back(work);
  work();
  others.clear();  // joins
  return lengths;
}

}  // namespace seldinger::imaging
