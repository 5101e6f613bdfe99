// Where the beams of a view lie: side by side from a straight face, or fanned from the centre of a curved one. The
// tissue that points are in, with what is inserted.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "shaders/shared/ultrasound_lattice.glsl.h"
#include "sim/imaging/ultrasound/view/lesion_echo.h"
#include "sim/imaging/ultrasound/view/ultrasound.h"

namespace seldinger::imaging {

struct Fan {
  bool curved;
  double radius_mm;   // 0 for a straight face
  double beam_step;   // between beams: radians, or mm for a straight face
  double first_beam;  // of beam 0, same unit
  double sample_mm;
  glm::dvec3 origin_lps_mm, axial, lateral, elevation;

  glm::dvec3 direction(double beam) const noexcept;
  glm::dvec3 start_lps_mm(double beam) const noexcept;  // on the face
  // Both at once: the angle's sine and cosine are found once.
  struct Way {
    glm::dvec3 start_lps_mm, direction;
    glm::dvec3 at(double depth_mm) const noexcept { return start_lps_mm + depth_mm * direction; }
  };
  Way way(double beam) const noexcept;
  double beam_spacing_mm(double depth_mm) const noexcept;
  // Of a point in the plane, so far along the face and from it.
  double beam(double x_mm, double z_mm) const noexcept;
  double depth_mm(double x_mm, double z_mm) const noexcept;
};
Fan fan_of(const UltrasoundView& view) noexcept;

bool is_shown(const cases::Lesion& lesion) noexcept;  // drawn over the volume: finite, with a radius
// Whether the element in the middle of a beam's aperture is in contact; `beam` is continuous. An empty list: all
// are.
bool beam_touches(const UltrasoundView& view, std::span<const float> depth_below_skin_mm, double beam) noexcept;

struct SideBySide;

// Tissue at points; outside the volume there is air.
class TissueAt {
 public:
  TissueAt(const TissueVolume& tissue, const Inserted& inserted);
  volume::TissueClass operator()(const glm::dvec3& p_lps_mm) const noexcept {
    double away_2 = 0.0;
    if (const Sphere* lesion = lesion_at(p_lps_mm, away_2)) return lesion->part(away_2).tissue;
    const std::int64_t at = voxel_at(p_lps_mm);
    return at < 0 ? volume::TissueClass::air : classes_[at];
  }
  void of(SideBySide& places, std::span<volume::TissueClass> tissue) const noexcept;  // of many (tissue_along.h)
  // Amplitude of the speckle, 1 for liver.
  float speckle(const glm::dvec3& p_lps_mm) const noexcept {
    if (const auto of_lesion = speckle_of_lesion(p_lps_mm)) return *of_lesion;
    return speckle_of(voxel_at(p_lps_mm));
  }
  // Of the lesion there.
  std::optional<float> speckle_of_lesion(const glm::dvec3& p_lps_mm) const noexcept {
    double away_2 = 0.0;
    const Sphere* lesion = lesion_at(p_lps_mm, away_2);
    if (lesion == nullptr) return std::nullopt;
    const Part& part = lesion->part(away_2);
    const float own =
        part.texture ? part.amplitude * part.texture->at(p_lps_mm - lesion->center_lps_mm) : part.amplitude;
    if (away_2 <= lesion->sharp_2) return own;
    const double share = (lesion->radius_mm - std::sqrt(away_2)) / lesion->margin_mm;
    return shaders::us_margin_amplitude(own, lesion->about, std::max(0.0F, static_cast<float>(share)));
  }
  bool has_lesions_near(const glm::dvec3& p_lps_mm, double reach_mm) const noexcept;
  // Of the volume alone, at a place told in voxels: index + ½, so that truncation is the nearest.
  float speckle_of_voxel(const glm::vec3& voxels) const noexcept {
    const bool inside = voxels.x >= 0.0F && voxels.y >= 0.0F && voxels.z >= 0.0F && voxels.x < size_.x &&
                        voxels.y < size_.y && voxels.z < size_.z;
    return speckle_of(inside ? static_cast<std::int64_t>(voxels.x) + row_ * static_cast<std::int64_t>(voxels.y) +
                                   slice_ * static_cast<std::int64_t>(voxels.z)
                             : -1);
  }
  glm::dvec3 voxels_at(const glm::dvec3& p_lps_mm) const noexcept { return voxels_along(p_lps_mm) + d_; }
  glm::dvec3 voxels_along(const glm::dvec3& way_mm) const noexcept {
    return a_ * way_mm.x + b_ * way_mm.y + c_ * way_mm.z;
  }

 private:
  struct Part {
    volume::TissueClass tissue;
    float amplitude;
    std::optional<Texture> texture{};
  };
  struct Sphere {
    glm::dvec3 center_lps_mm;
    double radius_mm, radius_2, inner_2;
    Part inside, rim;
    double sharp_2, margin_mm;  // its margin lies farther away than that
    float about;                // amplitude
    const Part& part(double away_2) const noexcept { return away_2 <= inner_2 ? inside : rim; }
  };
  const Sphere* lesion_at(const glm::dvec3& p_lps_mm, double& away_2) const noexcept {
    for (const Sphere& s : lesions_) {
      const glm::dvec3 d = p_lps_mm - s.center_lps_mm;
      away_2 = d.x * d.x + d.y * d.y + d.z * d.z;
      if (away_2 <= s.radius_2) return &s;
    }
    return nullptr;
  }
  float speckle_of(std::int64_t voxel) const noexcept {
    if (voxel < 0) return amplitude_[static_cast<std::size_t>(volume::TissueClass::air)];
    const float of_class = amplitude_[static_cast<std::size_t>(classes_[voxel])];
    return echogenicity_ == nullptr ? of_class : of_class * offset_[echogenicity_[voxel]];
  }
  // −1 outside.
  std::int64_t voxel_at(const glm::dvec3& p_lps_mm) const noexcept {
    const double i = a_.x * p_lps_mm.x + b_.x * p_lps_mm.y + c_.x * p_lps_mm.z + d_.x;
    const double j = a_.y * p_lps_mm.x + b_.y * p_lps_mm.y + c_.y * p_lps_mm.z + d_.y;
    const double k = a_.z * p_lps_mm.x + b_.z * p_lps_mm.y + c_.z * p_lps_mm.z + d_.z;
    if (!(i >= 0.0 && j >= 0.0 && k >= 0.0 && i < nx_ && j < ny_ && k < nz_)) return -1;
    return static_cast<std::int64_t>(i) + row_ * static_cast<std::int64_t>(j) +
           slice_ * static_cast<std::int64_t>(k);
  }

  std::vector<Sphere> lesions_;
  glm::dvec3 a_, b_, c_, d_;  // columns of index + ½ from LPS: truncation is the nearest voxel
  double nx_, ny_, nz_;
  glm::vec3 size_;  // the same
  std::int64_t row_, slice_;
  const volume::TissueClass* classes_;
  const std::uint8_t* echogenicity_;
  std::array<float, volume::kTissueClasses> amplitude_;
  const float* offset_;
};

}  // namespace seldinger::imaging
