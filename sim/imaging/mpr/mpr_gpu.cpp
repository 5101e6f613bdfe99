#include <cstddef>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "shaders/shared/mpr.glsl.h"
#include "sim/base/check.h"
#include "sim/base/embedded.h"
#include "sim/gpu/buffer.h"
#include "sim/gpu/program.h"
#include "sim/gpu/texture.h"
#include "sim/imaging/mpr/mpr.h"
#include "sim/imaging/mpr/plane.h"

namespace seldinger::embedded {
std::span<const base::EmbeddedFile> mpr_shaders();
}

namespace seldinger::imaging {
namespace {

using shaders::MprDisplaced;
using shaders::MprParameters;
static_assert(offsetof(MprParameters, index_first) == 0);
static_assert(offsetof(MprParameters, position_first_mm) == 48);
static_assert(offsetof(MprParameters, needle_tip_mm) == 96);
static_assert(offsetof(MprParameters, needle_inner_radius_mm) == 144);
static_assert(offsetof(MprParameters, lesion_count) == 160);
static_assert(offsetof(MprParameters, size_z) == 180);
static_assert(offsetof(MprParameters, lesion_sphere_mm) == 192);
static_assert(offsetof(MprParameters, lesion_hu) == 448);
static_assert(sizeof(MprParameters) == 704);
static_assert(offsetof(MprDisplaced, fixed_point_steps) == 80);
static_assert(sizeof(MprDisplaced) == 112);

constexpr int kGroupPx = 16;  // local_size_x and _y of the shader
constexpr int kTextureUnit = 0, kParametersBinding = 0, kPictureBinding = 1;
constexpr int kDisplacedBinding = 1, kSourcesBinding = 2;  // of uniform blocks
constexpr int kGridBinding = 2;                            // of storage

std::string_view shader(std::string_view name) {
  return base::content_of(embedded::mpr_shaders(), name);
}

glm::vec4 vec4_from(const glm::dvec3& xyz, double w = 0.0) {
  return glm::vec4(glm::dvec4(xyz, w));
}

MprParameters parameters_from(const glm::dmat4& voxel_from_lps, glm::ivec3 size_voxels, const MprView& view,
                              const Inserted& inserted) {
  const Plane plane = plane_from_view(voxel_from_lps, view);
  MprParameters p{};
  p.index_first = vec4_from(plane.index_first);
  p.index_per_column = vec4_from(plane.index_per_column);
  p.index_per_row = vec4_from(plane.index_per_row);
  p.position_first_mm = vec4_from(plane.position_first_mm);
  p.position_per_column_mm = vec4_from(plane.position_per_column_mm);
  p.position_per_row_mm = vec4_from(plane.position_per_row_mm);
  p.width_px = view.width_px;
  p.height_px = view.height_px;
  p.size_x = size_voxels.x;
  p.size_y = size_voxels.y;
  p.size_z = size_voxels.z;
  p.nearest = view.interpolation == Interpolation::nearest ? 1 : 0;
  if (inserted.needle && is_finite(*inserted.needle)) {
    const NeedlePose& needle = *inserted.needle;
    const double along = glm::dot(plane.normal, needle.direction);
    p.needle_present = 1;
    p.needle_tip_mm = vec4_from(needle.tip_lps_mm - view.center_lps_mm, needle.length_mm);
    p.needle_direction = vec4_from(needle.direction, needle.radius_mm);
    p.needle_normal_across = vec4_from(plane.normal - along * needle.direction, along);
    p.needle_inner_radius_mm = static_cast<float>(needle.inner_radius_mm);
    p.needle_slab_half_mm = static_cast<float>(0.5 * view.needle_slab_mm);
    p.needle_hu = static_cast<float>(needle.hu);
  }
  for (const cases::Lesion& lesion : inserted.lesions) {
    if (lesion.in_volume()) continue;
    p.lesion_sphere_mm[p.lesion_count] = vec4_from(lesion.center_lps_mm - view.center_lps_mm, lesion.radius_mm);
    p.lesion_hu[p.lesion_count].x = static_cast<float>(lesion.hu);
    ++p.lesion_count;
  }
  return p;
}

}  // namespace

namespace {

// What pictures of a patient who moves need besides.
struct Moving {
  Moving(gpu::Context& context, WayBack asked)
      : way_back(asked),
        slice(context, shader(asked == WayBack::grid ? "mpr_displaced_grid.comp" : "mpr_displaced.comp")),
        displaced(context, gpu::BufferUse::uniform, sizeof(MprDisplaced)),
        sources(context, gpu::BufferUse::uniform, sizeof(tissue::Displacement)),
        grid(context, gpu::BufferUse::storage, sizeof(glm::vec4)) {}

  void set(const glm::dmat4& voxel_from_lps, const MprView& view, const tissue::Displacement& displacement) {
    MprDisplaced parameters{};
    parameters.voxel_from_center = glm::mat4(voxel_from_lps * glm::translate(glm::dmat4(1.0), view.center_lps_mm));
    parameters.center_lps_mm = vec4_from(view.center_lps_mm);
    if (way_back == WayBack::grid) {
      const tissue::RestPlane plane = rest_plane_of(view, displacement);
      parameters.columns = plane.columns();
      parameters.rows = plane.rows();
      parameters.nodes_per_pixel = static_cast<float>(view.pixel_mm / tissue::kRestSpacingMm);
      std::vector<glm::vec4> moved_mm;
      for (const glm::dvec3& moved : plane.moved_mm()) moved_mm.push_back(vec4_from(moved));
      const auto bytes = std::as_bytes(std::span(moved_mm));
      if (grid.size() < bytes.size()) grid.resize(bytes.size());
      grid.write(bytes);
      grid.bind(kGridBinding);
    } else {
      const tissue::InverseSteps steps = tissue::picture_steps(displacement);
      parameters.fixed_point_steps = steps.fixed_point;
      parameters.newton_steps = steps.newton;
      sources.write(std::as_bytes(std::span(&displacement, 1)));
      sources.bind(kSourcesBinding);
    }
    displaced.write(std::as_bytes(std::span(&parameters, 1)));
    displaced.bind(kDisplacedBinding);
  }

  WayBack way_back;
  gpu::Program slice;
  gpu::Buffer displaced, sources, grid;
};

}  // namespace

struct MprGpu::Parts {
  Parts(gpu::Context& context, const volume::Volume& volume)
      : voxel_from_lps(volume::voxel_from_lps(volume)),
        size_voxels(volume.size_voxels),
        slice(context, shader("mpr_slice.comp")),
        voxels(context, volume.size_voxels, volume.hu),
        parameters(context, gpu::BufferUse::uniform, sizeof(MprParameters)),
        picture(context, gpu::BufferUse::storage, sizeof(float)) {}

  glm::dmat4 voxel_from_lps;
  glm::ivec3 size_voxels;
  gpu::Program slice;
  std::optional<Moving> moving;
  gpu::Texture voxels;
  gpu::Buffer parameters;
  gpu::Buffer picture;  // as large as the largest picture so far
};

MprGpu::MprGpu(gpu::Context& context, const volume::Volume& volume, WayBack way_back)
    : parts_(std::make_unique<Parts>(context, volume)) {
  if (way_back != WayBack::none) parts_->moving.emplace(context, way_back);
}

MprGpu::~MprGpu() = default;

HuImage MprGpu::render(const MprView& view, const Inserted& inserted) {
  return render(view, inserted, tissue::Displacement{});
}

HuImage MprGpu::render(const MprView& view, const Inserted& inserted, const tissue::Displacement& displacement) {
  const bool moves = tissue::count_sources(displacement) > 0;
  CHECK(!moves || parts_->moving);
  check_view(view, inserted);
  HuImage image(static_cast<std::size_t>(view.width_px) * static_cast<std::size_t>(view.height_px));
  const std::span<std::byte> bytes = std::as_writable_bytes(std::span(image));
  if (parts_->picture.size() < bytes.size()) parts_->picture.resize(bytes.size());
  const MprParameters parameters = parameters_from(parts_->voxel_from_lps, parts_->size_voxels, view, inserted);
  parts_->parameters.write(std::as_bytes(std::span(&parameters, 1)));
  parts_->parameters.bind(kParametersBinding);
  parts_->picture.bind(kPictureBinding);
  parts_->voxels.bind(kTextureUnit);
  if (moves) parts_->moving->set(parts_->voxel_from_lps, view, displacement);
  (moves ? parts_->moving->slice : parts_->slice)
      .dispatch((view.width_px + kGroupPx - 1) / kGroupPx, (view.height_px + kGroupPx - 1) / kGroupPx, 1);
  parts_->picture.read(bytes);
  return image;
}

}  // namespace seldinger::imaging
