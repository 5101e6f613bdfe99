// A probe led without force feedback: its face's centre stands over one place of the skin, pressed in or lifted off
// along the probe's axis. Sliding moves that place over the skin, and the probe's axis follows the skin's normal
// unless it is to keep its tilt. Moves are cut to a hand's speed by the caller.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "sim/case/form/mesh_index.h"
#include "sim/case/inputs.h"

namespace seldinger::devices {

// From lifted well off to pressed into a soft flank; and as far as a probe is tilted on skin without losing
// contact.
inline constexpr double kLeastPressMm = -60.0, kMostPressMm = 25.0;
inline constexpr double kMostProbeTiltRad = 1.0471975511965976;  // 60°

// The skin's outward unit normal as a face of a few cm lies on it: of the distance field above a ring of
// kFaceRadiusMm, so that no triangle's edge is felt. `hint`: as MeshIndex's.
inline constexpr double kFaceRadiusMm = 10.0;
glm::dvec3 face_normal(const cases::MeshIndex& skin, const glm::dvec3& at_lps_mm, const glm::dvec3& outwards,
                       std::uint32_t hint) noexcept;

class ProbeOnSkin {
 public:
  // Over the place where its axis meets the skin; else over the nearest. The skin must outlive this.
  ProbeOnSkin(const cases::MeshIndex& skin, const cases::ToolPose& start);

  const cases::ToolPose& pose() const noexcept { return pose_; }
  const glm::dvec3& contact_lps_mm() const noexcept { return contact_lps_mm_; }
  double press_mm() const noexcept { return press_mm_; }

  // The part along the skin only. Where the skin ends, or folds over, it stops.
  void slide(const glm::dvec3& by_lps_mm, bool keep_tilt) noexcept;
  void turn(const glm::dvec3& by_rad) noexcept;  // about the face's place on the skin
  double press(double by_mm) noexcept;           // what was done of it
  // Over the skin towards where `goal` is, by no more than that; whether it is there.
  bool approach(const ProbeOnSkin& goal, double most_mm, double most_rad) noexcept;

 private:
  void stand() noexcept;

  const cases::MeshIndex* skin_;
  cases::ToolPose pose_;
  glm::dvec3 contact_lps_mm_{0.0}, normal_{0.0};
  double press_mm_ = 0.0;
  std::uint32_t triangle_ = 0;
};

}  // namespace seldinger::devices
