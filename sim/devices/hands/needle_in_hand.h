// A needle led without force feedback. In the air it goes where the hand wants and turns about its tip; skin stops
// it sideways, so that it can be set down; only an advance punctures. In tissue it goes along its own axis and
// turns about its entry, as far as tissue lets it. Moves are cut to a hand's speed by the caller.
#pragma once

#include <glm/vec3.hpp>

#include "sim/case/form/mesh_index.h"
#include "sim/case/inputs.h"
#include "sim/case/skin_passage.h"

namespace seldinger::devices {

// How far tissue lets a needle turn about its entry: by kMostPivotRad (20°), and its tip sideways by kMostSweepMm
// from where the needle was led (design: redirecting takes withdrawing, as it does in a patient).
inline constexpr double kMostPivotRad = 0.3490658503988659, kMostSweepMm = 6.0;
// A new direction becomes the track's after about this much of way along it.
inline constexpr double kTrackMm = 10.0;
// How far above the skin a needle that was pushed against it stands: rounding does not puncture.
inline constexpr double kSkinGapMm = 0.01;
// A dragged hub is not nearer to the skin than this, however deep the needle is: the hand holds it.
inline constexpr double kLeastLeverMm = 40.0;

double most_pivot_rad(double inserted_mm) noexcept;

class NeedleInHand {
 public:
  // The skin must outlive this. In the body at once: inserted through the skin behind it.
  NeedleInHand(const cases::MeshIndex& skin, const cases::ToolPose& start, double length_mm);

  const cases::ToolPose& pose() const noexcept { return pose_; }
  bool inserted() const noexcept { return inserted_; }
  const glm::dvec3& entry_lps_mm() const noexcept { return entry_lps_mm_; }  // where it is inserted
  double inserted_mm() const noexcept;                                       // along the axis; 0: not inserted

  // In tissue the hub is moved so, across the axis.
  void slide(const glm::dvec3& by_lps_mm) noexcept;
  void turn(const glm::dvec3& by_rad) noexcept;
  // Along the axis. In the air a way onto the skin ends at it: the next one punctures. No cut cap is passed, nor
  // the hub brought below the skin. What was done of it.
  double advance(double by_mm) noexcept;
  // Led by a guide, in the air only (CHECKed).
  void place(const cases::ToolPose& pose) noexcept;

 private:
  void settle() noexcept;

  const cases::MeshIndex* skin_;
  double length_mm_;
  cases::ToolPose pose_;
  cases::SkinPassage passage_;
  bool inserted_ = false;
  glm::dvec3 entry_lps_mm_{0.0}, track_{0.0};  // and the direction in which it was led
};

}  // namespace seldinger::devices
