// Which tissues a needle meets along its line, told from the volume's classes: what the needle's law is asked with.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "sim/case/case.h"
#include "sim/haptics/needle/needle_law.h"
#include "sim/volume/volume.h"

namespace seldinger::haptics {

inline constexpr std::size_t kMostFeltLesions = 16;   // of a scene; as many as pictures draw
inline constexpr std::size_t kMostNeedleLayers = 32;  // what comes after is as the last of them

// A plain value of fixed size, so that it can stand where nothing may be allocated.
struct NeedlePath {
  std::array<NeedleLayer, kMostNeedleLayers> layers{};
  std::array<volume::TissueClass, kMostNeedleLayers> tissues{};  // of the scene's lesion i: kTissueClasses + i
  std::size_t count = 0;

  std::span<const NeedleLayer> span() const noexcept { return {layers.data(), count}; }
};

class TissueAlongNeedle {
 public:
  // One class per voxel (CHECKed). Both must outlive this. Lesions come before the volume, the first that contains
  // a point wins; left out are those by HU that lie in the volume, as their class does.
  TissueAlongNeedle(const volume::Volume& volume, std::span<const volume::TissueClass> classes,
                    const cases::Gauge& gauge, std::span<const cases::Lesion> lesions = {},
                    const cases::Touch& touch = {});

  // Skin as this needle feels it.
  const NeedleTissue& skin() const noexcept { return row(volume::TissueClass::skin); }

  // The line from `entry_lps_mm` on the skin (depth 0) along the unit vector `direction`, as far as `length_mm`.
  // Layers of `path` that the track has entered, or that the tip at depth_mm is beyond, stay as they are; those
  // ahead are looked up anew. A new needle: an empty path. Allocates nothing.
  void look(const glm::dvec3& entry_lps_mm, const glm::dvec3& direction, double length_mm, double depth_mm,
            const NeedleTrack& track, NeedlePath& path) const noexcept;

 private:
  struct Sample {
    volume::TissueClass tissue;
    double hu;
  };
  // What a needle meets of a lesion, whatever pictures draw it with.
  struct Felt {
    volume::TissueClass as;  // kTissueClasses + which
    cases::Shape shape;
    cases::Bounds bounds;
    NeedleTissue tissue;  // at the gauge
    double hu;
  };
  const Felt* lesion_at(const glm::dvec3& p_lps_mm) const noexcept;
  Sample at(const glm::dvec3& p_lps_mm) const noexcept;
  const NeedleTissue& row(volume::TissueClass tissue) const noexcept;
  void add(double start_mm, volume::TissueClass tissue, NeedlePath& path) const noexcept;

  const volume::Volume* volume_;
  std::span<const volume::TissueClass> classes_;
  glm::dmat4 voxel_from_lps_;
  cases::Gauge gauge_;
  cases::Touch touch_;
  std::array<NeedleTissue, volume::kTissueClasses> rows_;
  std::vector<Felt> lesions_;
};

}  // namespace seldinger::haptics
