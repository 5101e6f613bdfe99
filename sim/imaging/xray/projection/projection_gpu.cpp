#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "shaders/shared/xray_layer.glsl.h"
#include "sim/base/check.h"
#include "sim/base/embedded.h"
#include "sim/gpu/buffer.h"
#include "sim/gpu/program.h"
#include "sim/gpu/texture.h"
#include "sim/gpu/timer.h"
#include "sim/imaging/float_pair.h"
#include "sim/imaging/xray/projection/attenuating_box.h"
#include "sim/imaging/xray/projection/projection.h"

namespace seldinger::embedded {
std::span<const base::EmbeddedFile> xray_shaders();
}

namespace seldinger::imaging {
namespace {

using shaders::kXrayBlock;
using shaders::XrayParameters;
static_assert(offsetof(XrayParameters, pixel_first) == 0);
static_assert(offsetof(XrayParameters, pixel_per_column) == 32);
static_assert(offsetof(XrayParameters, pixel_per_row) == 64);
static_assert(offsetof(XrayParameters, source) == 96);
static_assert(offsetof(XrayParameters, clip_low) == 128);
static_assert(offsetof(XrayParameters, metric) == 160);
static_assert(offsetof(XrayParameters, metric_mixed) == 176);
static_assert(offsetof(XrayParameters, width_px) == 192);
static_assert(offsetof(XrayParameters, size_x) == 208);
static_assert(offsetof(XrayParameters, wins_ties_y) == 224);
static_assert(sizeof(XrayParameters) == 240);

constexpr int kGroupPx = 8;  // local_size_x and _y of the shader
constexpr int kTiles = 8;    // tiles along a side of the picture in which main axes are looked for
constexpr int kVoxelsUnit = 0, kCellsUnit = 1;
constexpr int kParametersBinding = 0, kWaterBinding = 1, kMineralBinding = 2;

std::string_view shader(std::string_view name) {
  return base::content_of(embedded::xray_shaders(), name);
}

// The axes of one walk: main, and the two minor ones in order.
using Axes = std::array<int, 3>;
constexpr std::array<Axes, 3> kAxes = {{{0, 1, 2}, {1, 0, 2}, {2, 0, 1}}};

template <typename Vector>
Vector turned(const Vector& v, const Axes& axes) {
  return Vector(v[axes[0]], v[axes[1]], v[axes[2]]);
}

// What the shader reads of the volume when rays run along `axes`.
struct Layers {
  Layers(const std::shared_ptr<gpu::Handles>& handles, glm::ivec3 voxels_size,
         std::span<const std::uint16_t> voxel_values, glm::ivec3 cells_size,
         std::span<const std::uint16_t> cell_values)
      : voxels(handles, voxels_size, voxel_values), cells(handles, cells_size, cell_values) {}
  gpu::Texture voxels, cells;
};

// HU + 1000, at least 0: what attenuates, in thousandths of water. A layer of the main axis is a slice.
std::vector<std::uint16_t> voxels_of(const volume::Volume& volume, const VoxelBox& box, const Axes& axes) {
  const glm::ivec3 size = turned(box.size(), axes);
  std::array<std::ptrdiff_t, 3> stride{};
  for (std::size_t i = 0; i < 3; ++i)
    stride[i] = axes[i] == 0   ? 1
                : axes[i] == 1 ? volume.size_voxels.x
                               : std::ptrdiff_t{volume.size_voxels.x} * volume.size_voxels.y;
  std::vector<std::uint16_t> values;
  values.reserve(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                 static_cast<std::size_t>(size.z));
  const std::int16_t* first = volume.hu.data() + volume.index(box.low.x, box.low.y, box.low.z);
  for (int x = 0; x < size.x; ++x)
    for (int z = 0; z < size.z; ++z) {
      const std::int16_t* row = first + x * stride[0] + z * stride[2];
      for (int y = 0; y < size.y; ++y)
        values.push_back(static_cast<std::uint16_t>(std::max(0, row[y * stride[1]] - kNothingHu)));
    }
  return values;
}

// Cells of kXrayBlock voxels along each side. Bit 0: this one holds something; 1: the next along y; 2: along z; 3:
// along both. A cell counts a voxel on each side of it along the minor axes, as interpolation reaches there.
std::vector<std::uint16_t> cells_of(std::span<const std::uint16_t> voxels, glm::ivec3 size, glm::ivec3 cells) {
  const auto at = [&](int x, int y, int z) {
    return (static_cast<std::size_t>(x) * static_cast<std::size_t>(cells.z) + static_cast<std::size_t>(z)) *
               static_cast<std::size_t>(cells.y) +
           static_cast<std::size_t>(y);
  };
  std::vector<std::uint16_t> bits(static_cast<std::size_t>(cells.x) * static_cast<std::size_t>(cells.y) *
                                  static_cast<std::size_t>(cells.z));
  const auto around = [](int voxel, int count) {
    return std::pair(std::max(0, voxel - 1) / kXrayBlock, std::min(count - 1, voxel + 1) / kXrayBlock);
  };
  std::size_t voxel = 0;
  for (int x = 0; x < size.x; ++x)
    for (int z = 0; z < size.z; ++z) {
      const auto [z0, z1] = around(z, size.z);
      for (int y = 0; y < size.y; ++y) {
        if (voxels[voxel++] == 0) continue;
        const auto [y0, y1] = around(y, size.y);
        for (const int cell_z : {z0, z1})
          for (const int cell_y : {y0, y1}) bits[at(x / kXrayBlock, cell_y, cell_z)] = 1;
      }
    }
  for (int x = 0; x < cells.x; ++x)
    for (int z = 0; z < cells.z; ++z)
      for (int y = 0; y < cells.y; ++y) {
        // In this order neighbours still hold bit 0 alone.
        const bool more_y = y + 1 < cells.y, more_z = z + 1 < cells.z;
        const int next_y = more_y ? bits[at(x, y + 1, z)] : 0, next_z = more_z ? bits[at(x, y, z + 1)] : 0;
        const int next = more_y && more_z ? bits[at(x, y + 1, z + 1)] : 0;
        bits[at(x, y, z)] = static_cast<std::uint16_t>(bits[at(x, y, z)] | next_y << 1 | next_z << 2 | next << 3);
      }
  return bits;
}

std::unique_ptr<Layers> layers_of(const std::shared_ptr<gpu::Handles>& handles, const volume::Volume& volume,
                                  const VoxelBox& box, const Axes& axes) {
  const glm::ivec3 size = turned(box.size(), axes), cells = (size + (kXrayBlock - 1)) / kXrayBlock;
  const std::vector<std::uint16_t> voxels = voxels_of(volume, box, axes);
  return std::make_unique<Layers>(handles, glm::ivec3(size.y, size.z, size.x), voxels,
                                  glm::ivec3(cells.y, cells.z, cells.x), cells_of(voxels, size, cells));
}

// The rays of a picture in voxel faces of the box: pixel and direction are affine in column and row.
struct Rays {
  glm::dvec3 pixel_first, per_column, per_row;
  glm::dvec3 from_first;  // of pixel (0,0)
  bool parallel;
  int width_px, height_px;

  glm::dvec3 along(double column, double row) const {
    return parallel ? pixel_first - from_first : pixel_first - from_first + column * per_column + row * per_row;
  }
};

Rays rays_of(const XrayGeometry& geometry, const volume::Volume& volume, const VoxelBox& box) {
  const glm::dmat4 voxel_from_lps = volume::voxel_from_lps(volume);
  const auto place = [&](const glm::dvec3& lps_mm) {
    return glm::dvec3(voxel_from_lps * glm::dvec4(lps_mm, 1.0)) + 0.5 - glm::dvec3(box.low);
  };
  const RaySegment first = ray_of(geometry, volume, 0, 0);
  const glm::dmat3 turn(voxel_from_lps);
  return {place(first.to_lps_mm),
          turn * (geometry.pixel_mm * geometry.u),
          turn * (geometry.pixel_mm * geometry.v),
          place(first.from_lps_mm),
          !geometry.source_lps_mm,
          geometry.width_px,
          geometry.height_px};
}

// A rectangle of pixels.
struct Patch {
  int column_first, row_first, column_end, row_end;
};

// For each axis the pixels that can hold rays whose main axis it is. A direction's component is affine in column
// and row, so in a tile it stays within what it is at the tile's corners.
std::array<std::optional<Patch>, 3> patches_of(const Rays& rays) {
  constexpr double kRounding = 1.0 + 1e-9;
  std::array<std::optional<Patch>, 3> patches;
  for (int tile = 0; tile < kTiles * kTiles; ++tile) {
    const auto edge = [](int part, int pixels) { return static_cast<int>(std::int64_t{pixels} * part / kTiles); };
    const Patch here{edge(tile % kTiles, rays.width_px), edge(tile / kTiles, rays.height_px),
                     edge(tile % kTiles + 1, rays.width_px), edge(tile / kTiles + 1, rays.height_px)};
    if (here.column_end <= here.column_first || here.row_end <= here.row_first) continue;
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const int column : {here.column_first, here.column_end - 1})
      for (const int row : {here.row_first, here.row_end - 1}) {
        low = glm::min(low, rays.along(column, row));
        high = glm::max(high, rays.along(column, row));
      }
    const glm::dvec3 most = glm::max(glm::abs(low), glm::abs(high));
    const glm::dvec3 least = glm::max(glm::max(low, -high), glm::dvec3(0.0));
    for (int axis = 0; axis < 3; ++axis) {
      if (most[axis] * kRounding < std::max({least.x, least.y, least.z})) continue;
      std::optional<Patch>& patch = patches[static_cast<std::size_t>(axis)];
      patch = patch ? Patch{std::min(patch->column_first, here.column_first),
                            std::min(patch->row_first, here.row_first),
                            std::max(patch->column_end, here.column_end), std::max(patch->row_end, here.row_end)}
                    : here;
    }
  }
  return patches;
}

XrayParameters parameters_from(const Rays& rays, const glm::dmat4& lps_from_voxel, const VoxelBox& texture,
                               const VoxelBox& clip, const Axes& axes, const Patch& patch, bool only) {
  XrayParameters p{};
  split(turned(rays.pixel_first, axes), p.pixel_first, p.pixel_first_rest);
  split(turned(rays.per_column, axes), p.pixel_per_column, p.per_column_rest);
  split(turned(rays.per_row, axes), p.pixel_per_row, p.per_row_rest);
  split(turned(rays.parallel ? rays.from_first - rays.pixel_first : rays.from_first, axes), p.source,
        p.source_rest);
  p.clip_low = glm::vec4(glm::vec3(turned(clip.low - texture.low, axes)), 0.0F);
  p.clip_high = glm::vec4(glm::vec3(turned(clip.high - texture.low, axes)), 0.0F);
  const glm::dvec3 x(lps_from_voxel[axes[0]]), y(lps_from_voxel[axes[1]]), z(lps_from_voxel[axes[2]]);
  p.metric = glm::vec4(glm::dvec4(glm::dot(x, x), glm::dot(y, y), glm::dot(z, z), 0.0));
  p.metric_mixed = glm::vec4(2.0 * glm::dvec4(glm::dot(x, y), glm::dot(x, z), glm::dot(y, z), 0.0));
  p.width_px = rays.width_px;
  p.height_px = rays.height_px;
  p.column_first = patch.column_first;
  p.row_first = patch.row_first;
  const glm::ivec3 size = turned(texture.size(), axes);
  p.size_x = size.x;
  p.size_y = size.y;
  p.size_z = size.z;
  p.parallel = rays.parallel ? 1 : 0;
  p.wins_ties_y = axes[0] < axes[1] ? 1 : 0;
  p.wins_ties_z = axes[0] < axes[2] ? 1 : 0;
  p.only_x = only ? 1 : 0;
  return p;
}

void read_into(std::vector<float>& values, const gpu::Buffer& buffer, std::size_t count) {
  values.resize(count);
  buffer.read(std::as_writable_bytes(std::span(values)));
}

}  // namespace

struct XrayGpu::Parts {
  Parts(gpu::Context& context, const volume::Volume& the_volume)
      : volume(the_volume),
        handles(context.handles()),
        tissue(attenuating_box(the_volume)),
        box(grown(tissue, the_volume.size_voxels)),
        exact(context, shader("xray_exact.comp")),
        exact_total(context, shader("xray_exact_total.comp")),
        slab(context, shader("xray_slab.comp")),
        slab_total(context, shader("xray_slab_total.comp")),
        parameters(context, gpu::BufferUse::uniform, sizeof(XrayParameters)),
        water(context, gpu::BufferUse::storage, sizeof(float)),
        mineral(context, gpu::BufferUse::storage, sizeof(float)),
        timer(context) {
    // What does not fit is told here. The layers themselves come when the first rays need them: of one main axis
    // mostly, of three for wide cones.
    for (const Axes& axes : kAxes) {
      const glm::ivec3 size = turned(glm::max(box.size(), glm::ivec3(0)), axes);
      gpu::Texture::check_size(handles, {size.y, size.z, size.x});
    }
  }

  Layers& layers_along(int axis) {
    std::unique_ptr<Layers>& known = layers[static_cast<std::size_t>(axis)];
    if (!known) known = layers_of(handles, volume, box, kAxes[static_cast<std::size_t>(axis)]);
    return *known;
  }

  gpu::Program& program(ProjectionMethod method, Basis basis) {
    if (method == ProjectionMethod::slab) return basis == Basis::total ? slab_total : slab;
    return basis == Basis::total ? exact_total : exact;
  }

  const volume::Volume& volume;
  std::shared_ptr<gpu::Handles> handles;
  VoxelBox tissue, box;  // box: what is uploaded, a voxel more on every side where there is one
  gpu::Program exact, exact_total, slab, slab_total;
  gpu::Buffer parameters;
  gpu::Buffer water, mineral;  // as large as the largest picture so far
  gpu::Timer timer;
  std::array<std::unique_ptr<Layers>, 3> layers;  // by main axis
  double last_ms = 0.0;
};

XrayGpu::XrayGpu(gpu::Context& context, const volume::Volume& volume)
    : parts_(std::make_unique<Parts>(context, volume)) {}

XrayGpu::~XrayGpu() = default;

PathLengths XrayGpu::project(const XrayGeometry& geometry, ProjectionMethod method, Basis basis) {
  CHECK(check_geometry(geometry).has_value());
  CHECK(method == ProjectionMethod::exact || method == ProjectionMethod::slab);
  Parts& parts = *parts_;
  PathLengths lengths{geometry.width_px, geometry.height_px, {}, {}, {}};
  const std::size_t pixels =
      static_cast<std::size_t>(geometry.width_px) * static_cast<std::size_t>(geometry.height_px);
  parts.last_ms = 0.0;
  if (parts.tissue.empty()) {
    lengths.water_mm.resize(pixels);
    if (basis != Basis::total) lengths.mineral_mm.resize(pixels);
    return lengths;
  }
  for (gpu::Buffer* buffer : {&parts.water, &parts.mineral})
    if (buffer->size() < pixels * sizeof(float) && (buffer == &parts.water || basis != Basis::total))
      buffer->resize(pixels * sizeof(float));
  parts.water.bind(kWaterBinding);
  parts.mineral.bind(kMineralBinding);
  const Rays rays = rays_of(geometry, parts.volume, parts.box);
  const auto patches = patches_of(rays);
  const bool only = std::count(patches.begin(), patches.end(), std::nullopt) == 2;
  gpu::Program& program = parts.program(method, basis);
  for (int axis = 0; axis < 3; ++axis) {
    const std::optional<Patch>& patch = patches[static_cast<std::size_t>(axis)];
    if (!patch) continue;
    const Layers& layers = parts.layers_along(axis);
    layers.voxels.bind(kVoxelsUnit);
    layers.cells.bind(kCellsUnit);
    const XrayParameters parameters = parameters_from(rays, parts.volume.lps_from_voxel, parts.box,
                                                      method == ProjectionMethod::slab ? parts.box : parts.tissue,
                                                      kAxes[static_cast<std::size_t>(axis)], *patch, only);
    parts.parameters.write(std::as_bytes(std::span(&parameters, 1)));
    parts.parameters.bind(kParametersBinding);
    const auto groups = [](int count) { return (count + kGroupPx - 1) / kGroupPx; };
    parts.timer.start();
    program.dispatch(groups(patch->column_end - patch->column_first), groups(patch->row_end - patch->row_first), 1);
    parts.last_ms += parts.timer.stop_ms();
  }
  read_into(lengths.water_mm, parts.water, pixels);
  if (basis != Basis::total) read_into(lengths.mineral_mm, parts.mineral, pixels);
  return lengths;
}

double XrayGpu::last_gpu_ms() const noexcept {
  return parts_->last_ms;
}

}  // namespace seldinger::imaging
