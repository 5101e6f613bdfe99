#include "sim/volume/body/body_mask.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "sim/volume/axial_slices.h"
#include "sim/volume/body/cut_air.h"
#include "sim/volume/body/field_of_view.h"
#include "sim/volume/components.h"

namespace seldinger::volume {
namespace {

// The cover of a couch's mattress may touch the back and so belong to the same component, though it is a sheet of 2
// to 3 mm. A part thinner than about 5 mm and longer than 80 mm is no part of a body; an ear or a finger is
// shorter.
constexpr double kSheetRadiusMm = 2.0, kSheetLengthMm = 80.0;

void drop_sheets(const Volume& volume, const AxialSlices& slices, std::vector<std::uint8_t>& mask) {
  const glm::dvec2 spacing_mm = slices.spacing_mm();
  const glm::ivec2 radius(std::max(1, static_cast<int>(std::lround(kSheetRadiusMm / spacing_mm.x))),
                          std::max(1, static_cast<int>(std::lround(kSheetRadiusMm / spacing_mm.y))));
  std::vector<std::uint8_t> kept = mask;
  Components(volume.size_voxels, thin_parts(slices, mask, radius))
      .paint(
          [&](const Piece& piece) {
            const glm::dvec3 extent_mm = glm::dvec3(piece.high - piece.low + 1) * volume.spacing_mm;
            return std::max({extent_mm.x, extent_mm.y, extent_mm.z}) >= kSheetLengthMm;
          },
          0, kept);
  Components(volume.size_voxels, kept).keep_largest(kept);
  // A body that is a sheet all over stays as it is.
  if (std::count(kept.begin(), kept.end(), 1) * 2 > std::count(mask.begin(), mask.end(), 1)) mask = std::move(kept);
}

// The largest piece, without its sheets and not yet filled; all 0 where nothing is above the threshold.
std::vector<std::uint8_t> largest_part(const Volume& volume, const AxialSlices& slices,
                                       std::vector<std::uint8_t> tissue) {
  Components(volume.size_voxels, tissue).keep_largest(tissue);
  if (std::find(tissue.begin(), tissue.end(), std::uint8_t{1}) != tissue.end()) drop_sheets(volume, slices, tissue);
  return tissue;
}

std::vector<std::uint8_t> above(const Volume& volume, int threshold_hu) {
  std::vector<std::uint8_t> mask(volume.hu.size());
  std::transform(volume.hu.begin(), volume.hu.end(), mask.begin(),
                 [&](std::int16_t hu) { return static_cast<std::uint8_t>(hu > threshold_hu ? 1 : 0); });
  return mask;
}

bool reaches_the_edge(const AxialSlices& slices, const std::vector<std::uint8_t>& body,
                      const std::vector<std::uint8_t>& padding) {
  const int width = slices.width(), height = slices.height();
  const auto is_out = [&](int slice, int x, int y) {
    return x < 0 || y < 0 || x >= width || y >= height ||
           (!padding.empty() && padding[slices.voxel(slice, x, y)] != 0);
  };
  for (int slice = 0; slice < slices.count(); ++slice)
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        if (body[slices.voxel(slice, x, y)] != 0 && (is_out(slice, x - 1, y) || is_out(slice, x + 1, y) ||
                                                     is_out(slice, x, y - 1) || is_out(slice, x, y + 1)))
          return true;
  return false;
}

// What is dense, thick and no part of the body so far: a couch's rail, or a wall of the chest that a cut has parted
// from the rest.
std::vector<std::uint8_t> parted(const Volume& volume, const AxialSlices& slices,
                                 const std::vector<std::uint8_t>& tissue, const std::vector<std::uint8_t>& body) {
  constexpr double kLeastMl = 5.0;
  std::vector<std::uint8_t> rest(tissue.size());
  for (std::size_t voxel = 0; voxel < rest.size(); ++voxel)
    rest[voxel] = tissue[voxel] != 0 && body[voxel] == 0 ? 1 : 0;
  const glm::ivec2 radius = glm::max(glm::ivec2(1), glm::ivec2(glm::round(kSheetRadiusMm / slices.spacing_mm())));
  const std::vector<std::uint8_t> thin = thin_parts(slices, rest, radius);
  for (std::size_t voxel = 0; voxel < rest.size(); ++voxel)
    if (thin[voxel] != 0) rest[voxel] = 0;
  const double voxel_ml = volume.spacing_mm.x * volume.spacing_mm.y * volume.spacing_mm.z * 1e-3;
  Components(volume.size_voxels, rest)
      .paint([&](const Piece& piece) { return static_cast<double>(piece.voxels) * voxel_ml < kLeastMl; }, 0, rest);
  return rest;
}

// Adds to the body the air that the edge cuts, and then those parted pieces that lie on it.
void add_what_is_cut(const Volume& volume, const AxialSlices& slices, const std::vector<std::uint8_t>& tissue,
                     const std::vector<std::uint8_t>& padding, std::vector<std::uint8_t>& body) {
  constexpr double kLeastContactMm2 = 400.0;
  std::vector<std::uint8_t> apart = parted(volume, slices, tissue, body), dense(tissue.size());
  for (std::size_t voxel = 0; voxel < dense.size(); ++voxel)
    dense[voxel] = body[voxel] != 0 || apart[voxel] != 0 ? 1 : 0;
  const std::vector<std::uint8_t> air = air_cut_by_edge(volume, slices, dense, body, padding);
  Components pieces(volume.size_voxels, apart);
  std::vector<double> contact_mm2(pieces.numbers(), 0.0);
  const glm::dvec3 mm = volume.spacing_mm;
  const auto row = static_cast<std::size_t>(volume.size_voxels.x),
             slice = row * static_cast<std::size_t>(volume.size_voxels.y);
  pieces.each_run([&](std::size_t piece, std::size_t begin, std::size_t end) {
    const auto touch = [&](std::size_t other, double area_mm2) {
      if (other < air.size() && air[other] != 0) contact_mm2[piece] += area_mm2;
    };
    touch(begin - 1, mm.y * mm.z), touch(end, mm.y * mm.z);
    for (std::size_t voxel = begin; voxel < end; ++voxel) {
      touch(voxel - row, mm.x * mm.z), touch(voxel + row, mm.x * mm.z);
      touch(voxel - slice, mm.x * mm.y), touch(voxel + slice, mm.x * mm.y);
    }
  });
  pieces.each_run([&](std::size_t piece, std::size_t begin, std::size_t end) {
    if (contact_mm2[piece] < kLeastContactMm2) return;
    std::fill(body.begin() + static_cast<std::ptrdiff_t>(begin), body.begin() + static_cast<std::ptrdiff_t>(end),
              std::uint8_t{1});
  });
  for (std::size_t voxel = 0; voxel < air.size(); ++voxel)
    if (air[voxel] != 0) body[voxel] = 1;
}

}  // namespace

std::vector<std::uint8_t> body_mask(const Volume& volume, int threshold_hu) {
  const AxialSlices slices(volume);
  std::vector<std::uint8_t> tissue = above(volume, threshold_hu);
  std::vector<std::uint8_t> body = largest_part(volume, slices, tissue);
  if (std::find(body.begin(), body.end(), std::uint8_t{1}) == body.end()) return body;
  const std::vector<std::uint8_t> padding = padding_of(volume);
  if (reaches_the_edge(slices, body, padding)) add_what_is_cut(volume, slices, tissue, padding, body);
  fill_slices(slices, body);  // padding is reached from the slice's border, as the room is
  return body;
}

std::vector<std::uint8_t> body_mask_by_rule_1(const Volume& volume, int threshold_hu) {
  const AxialSlices slices(volume);
  std::vector<std::uint8_t> body = largest_part(volume, slices, above(volume, threshold_hu));
  if (std::find(body.begin(), body.end(), std::uint8_t{1}) != body.end()) fill_slices(slices, body);
  return body;
}

}  // namespace seldinger::volume
