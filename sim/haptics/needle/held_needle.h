// A needle held in a hand, in space: where it is against the skin and its own track, and the force from that. The
// line of a track is fixed once the skin opens; before, it follows the hand. The devices here have three motors, so
// the force acts where the hand holds it and no torque is given.
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "sim/case/case.h"
#include "sim/case/inputs.h"
#include "sim/case/introducer.h"
#include "sim/case/skin_passage.h"
#include "sim/haptics/needle/needle_law.h"
#include "sim/haptics/needle/needle_path.h"
#include "sim/haptics/needle/needle_side.h"
#include "sim/tissue/displacement.h"

namespace seldinger::haptics {

using cases::Introducer;  // one that is left for another hole is forgotten

// What must be kept from tick to tick. A new one: just taken up. Taken up inside the body it is without force until
// it has been outside.
struct HeldNeedleState {
  cases::SkinPassage skin;                                 // of the tip
  glm::dvec3 entry_lps_mm{0.0}, direction{0.0, 0.0, 1.0};  // the track's line: depth 0, and unit, inwards
  NeedlePath path;
  NeedleTrack track;
  NeedleSideTrack side;
  double depth_mm = 0.0;   // of the tip along the line
  double looked_mm = 0.0;  // how far along the line the path is known
  int ticks_to_look = 0;   // while the line still moves
  Introducer introducer = Introducer::none;
  bool begun = false;       // `skin` says something
  bool free = false;        // it has been outside
  bool outside = true;      // of skin and track
  tissue::NeedleDrag drag;  // what the last tick does to the tissue; nothing where it does nothing
};

struct HeldNeedleForce {
  glm::dvec3 force_n{0.0};  // on the hand
  NeedleForce along;        // the track
};

class HeldNeedle {
 public:
  // The scene has a class per voxel (CHECKed) and must outlive this.
  explicit HeldNeedle(const cases::Case& scene);

  // The needle of the scene's instrument: what its side law needs.
  const cases::Gauge& gauge() const noexcept { return needle_.gauge; }

  // One tick: position = tip, axis = unit, hub → tip. nicks_lps_mm: where the skin is cut. Allocates nothing.
  HeldNeedleForce advance(const cases::ToolPose& pose, const NeedleLaw& law, const NeedleSideLaw& side_law,
                          std::span<const glm::dvec3> nicks_lps_mm, HeldNeedleState& state) const noexcept;
  // From the next tick on it is held with, through or without an introducer.
  void exchange(Introducer introducer, HeldNeedleState& state) const noexcept;

 private:
  const FeltNeedle& felt(Introducer introducer) const noexcept;
  double below_skin_mm(const cases::ToolPose& pose, const cases::SkinPassage& skin) const noexcept;

  const cases::Case* scene_;
  FeltNeedle needle_, introducer_;
  TissueAlongNeedle along_needle_, along_introducer_;
};

// What is left of the skin's resistance there: none within a nick, all of it beside.
double skin_share(const glm::dvec3& p_lps_mm, std::span<const glm::dvec3> nicks_lps_mm) noexcept;

// The hand was not followed for some ticks: the next has no speed.
void interrupt(HeldNeedleState& state) noexcept;

}  // namespace seldinger::haptics
