#include "tests/sim/imaging/mpr_scene.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace seldinger::imaging {

glm::dvec3 random_direction(base::Rng& rng) {
  return glm::normalize(glm::dvec3(rng.normal(), rng.normal(), rng.normal()));
}

glm::dmat3 random_rotation(base::Rng& rng) {
  const glm::dvec3 x = random_direction(rng);
  const glm::dvec3 y = glm::normalize(glm::cross(x, random_direction(rng)));
  return {x, y, glm::cross(x, y)};
}

volume::Volume noise_volume(glm::ivec3 size_voxels, glm::dvec3 spacing_mm, const glm::dmat3& direction,
                            glm::dvec3 center_lps_mm, std::uint64_t seed) {
  const glm::dvec3 middle_mm = direction * (spacing_mm * (glm::dvec3(size_voxels) - 1.0) * 0.5);
  volume::Volume volume = volume::make_volume(size_voxels, spacing_mm, direction, center_lps_mm - middle_mm);
  for (std::size_t i = 0; i < volume.hu.size(); ++i)
    volume.hu[i] = static_cast<std::int16_t>(std::floor(base::uniform_at(seed, i) * 4096.0) - 1024.0);
  return volume;
}

MprView random_view(base::Rng& rng, glm::dvec3 near_lps_mm, double spread_mm, double pixel_mm, int width_px,
                    int height_px, Interpolation interpolation) {
  const glm::dmat3 turn = random_rotation(rng);
  MprView view;
  view.center_lps_mm =
      near_lps_mm + spread_mm * glm::dvec3(rng.uniform() - 0.5, rng.uniform() - 0.5, rng.uniform() - 0.5);
  view.u = turn[0];
  view.v = turn[1];
  view.pixel_mm = pixel_mm;
  view.width_px = width_px;
  view.height_px = height_px;
  view.interpolation = interpolation;
  return view;
}

glm::dvec3 pixel_lps_mm(const MprView& view, int column, int row) {
  const double across = column - (view.width_px - 1) / 2.0, down = row - (view.height_px - 1) / 2.0;
  return view.center_lps_mm + view.u * (view.pixel_mm * across) + view.v * (view.pixel_mm * down);
}

PixelMask near_shape_edges(const MprView& view, const Inserted& inserted, double edge_mm) {
  // Over one empty voxel far away every shape shows its own number.
  const volume::Volume nothing =
      volume::make_volume({1, 1, 1}, glm::dvec3(1.0), glm::dmat3(1.0), view.center_lps_mm + 1e5);
  const auto shown = [&](double grow_mm, double shift_mm, double inner_mm) {
    MprView moved = view;
    Inserted shapes = inserted;
    double number = 1.0;
    for (cases::Lesion& lesion : shapes.lesions) {
      lesion.radius_mm += grow_mm;
      lesion.hu = number++;
    }
    if (shapes.needle) {
      NeedlePose& needle = *shapes.needle;
      needle.hu = 100.0;
      needle.radius_mm += grow_mm;
      needle.inner_radius_mm = needle.inner_radius_mm > 0.0 ? needle.inner_radius_mm + inner_mm : 0.0;
      needle.tip_lps_mm += needle.direction * shift_mm;
    }
    return mpr_reference(nothing, moved, shapes);
  };
  const HuImage as_is = shown(0.0, 0.0, 0.0);
  PixelMask near(as_is.size(), false);
  for (const double grow : {-edge_mm, 0.0, edge_mm})
    for (const double shift : {-edge_mm, 0.0, edge_mm})
      for (const double inner : {-edge_mm, 0.0, edge_mm}) {
        const HuImage other = shown(grow, shift, inner);
        for (std::size_t i = 0; i < near.size(); ++i) near[i] = near[i] || other[i] != as_is[i];
      }
  return near;
}

PixelMask near_voxel_faces(const volume::Volume& volume, const MprView& view, double voxels) {
  const glm::dmat4 voxel_from_lps = glm::inverse(volume.lps_from_voxel);
  PixelMask near;
  for (int row = 0; row < view.height_px; ++row)
    for (int column = 0; column < view.width_px; ++column) {
      const glm::dvec3 index(voxel_from_lps * glm::dvec4(pixel_lps_mm(view, column, row), 1.0));
      bool is_near = false;
      for (int axis = 0; axis < 3; ++axis) {
        const double from_face = index[axis] + 0.5;  // faces at whole numbers
        is_near =
            is_near || std::abs(from_face) < voxels || std::abs(from_face - volume.size_voxels[axis]) < voxels;
        if (view.interpolation == Interpolation::nearest)
          is_near = is_near || std::abs(from_face - std::round(from_face)) < voxels;
      }
      near.push_back(is_near);
    }
  return near;
}

PixelMask either(const PixelMask& a, const PixelMask& b) {
  PixelMask result = a;
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = result[i] || b[i];
  return result;
}

}  // namespace seldinger::imaging
