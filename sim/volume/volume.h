// The CT volume: int16 HU on a regular, possibly oblique or left-handed grid in DICOM patient coordinates (LPS,
// mm). Sampling here, in double, is the reference of every other sampler.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace seldinger::volume {

constexpr std::size_t kMaxVoxels = std::size_t{1}
                                   << 30;  // 2 GiB of HU: import, scenes and the library hold no more
constexpr double kMinSpacingMm = 0.01, kMaxSpacingMm = 100.0;  // no CT is finer or coarser
constexpr std::int16_t kAirHu = -1024;                         // padding and everything below becomes this

struct Volume {
  glm::ivec3 size_voxels{0};       // i fastest
  glm::dvec3 spacing_mm{1.0};      // > 0
  glm::dmat4 lps_from_voxel{1.0};  // of voxel centres at integer indices; columns = direction cosine · spacing
  std::vector<std::int16_t> hu;    // size.x·size.y·size.z, ≥ kAirHu

  std::size_t index(int i, int j, int k) const noexcept {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(size_voxels.y) + static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(size_voxels.x) +
           static_cast<std::size_t>(i);
  }
  std::int16_t at(int i, int j, int k) const noexcept { return hu[index(i, j, k)]; }
};

// direction: orthonormal columns (right- or left-handed). The volume is filled with kAirHu.
Volume make_volume(glm::ivec3 size_voxels, glm::dvec3 spacing_mm, const glm::dmat3& direction,
                   glm::dvec3 origin_mm);

// Exact inverse of the affine lps_from_voxel.
glm::dmat4 voxel_from_lps(const Volume& volume);

// Continuous index is inside when every component lies in [−0.5, n − 0.5]: faces are half a voxel beyond the
// centres.
bool inside(const Volume& volume, const glm::dvec3& index) noexcept;

// HU at a continuous voxel index; nothing outside. Trilinear clamps to the outermost centres in the last half
// voxel.
std::optional<std::int16_t> sample_nearest(const Volume& volume, const glm::dvec3& index) noexcept;
std::optional<double> sample_trilinear(const Volume& volume, const glm::dvec3& index) noexcept;

// Labels beside a volume of the same size: 0 is "no label", otherwise an index into names.
struct LabelMap {
  std::vector<std::uint8_t> label;
  std::vector<std::string> names;  // names[0] = "none"
};

}  // namespace seldinger::volume
