// A probe held in a hand, in space: how its head lies against the skin, how deep bone is there, and the force from
// that.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "sim/case/case.h"
#include "sim/case/inputs.h"
#include "sim/haptics/probe/bone_depth.h"
#include "sim/haptics/probe/probe_law.h"
#include "sim/tissue/displacement.h"

namespace seldinger::haptics {

// What must be kept from tick to tick. A new one: just taken up.
struct HeldProbeState {
  ProbeTrack track;
  glm::dvec3 asked_lps_mm{0.0};  // the head's middle, where the skin was last asked for,
  double gap_mm = 0.0;           // and how far the head was from the skin then
  double bone_mm = 0.0;          // below the skin, as last looked up
  std::uint32_t triangle = 0;    // nearest, the next query's hint
  int ticks_to_look = 0;         // for bone
  tissue::SkinPress press;       // what the last tick does to the tissue; of no depth where it does nothing
};

class HeldProbe {
 public:
  // The head is a sphere of radius_mm. The scene has a class per voxel (CHECKed) and must outlive this.
  HeldProbe(const cases::Case& scene, double radius_mm);

  // One tick: position = the head's foremost point, axis = unit, into the body. Allocates nothing.
  ProbeForce advance(const cases::ToolPose& pose, const ProbeLaw& law, HeldProbeState& state) const noexcept;

 private:
  const cases::Case* scene_;
  double radius_mm_;
  BoneDepth bone_;
};

// The hand was not followed for some ticks: the skin is touched anew.
void interrupt(HeldProbeState& state) noexcept;

}  // namespace seldinger::haptics
