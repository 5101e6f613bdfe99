// How a patient's tissue is displaced now: x = X + u(X), with X the place at rest, where the CT was taken. Built
// each tick or picture from what causes it; one value (shaders/shared/displacement.glsl.h) that touch, visibility
// and the shaders of every picture are handed. No cause, no source: a patient who lies still costs nothing.
//
// Pure, without allocation, and only + − × ÷ √: the same bits everywhere.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "shaders/shared/displacement_source.glsl.h"
#include "sim/tissue/breathing.h"
#include "sim/tissue/cavity_wall.h"
#include "sim/volume/classes.h"

namespace seldinger::tissue {

using shaders::Displacement;

// A round head, a ball as touch feels it (sim/haptics/contact/soft_contact.h), pressed into the skin.
struct SkinPress {
  glm::dvec3 at_lps_mm{0.0};          // on the skin at rest, under the head's deepest point
  glm::dvec3 inward{0.0, 0.0, -1.0};  // unit
  double radius_mm = 20.0;            // > 0
  double depth_mm = 0.0;              // of that point below the skin at rest; ≤ 0: no contact
  double per_bone_mm = 0.0;           // 1 / depth of bone below the skin; 0: none
};

// What touch knows of a needle in tissue (sim/haptics/needle/needle_law.h).
struct NeedleDrag {
  glm::dvec3 entry_lps_mm{0.0};          // where its line meets the skin, at rest
  glm::dvec3 direction{0.0, 0.0, -1.0};  // unit, inwards
  double radius_mm = 0.36;               // > 0
  double cut_mm = 0.0;                   // at rest, from the entry to where tissue is cut: what is now at the tip
  double tip_n = 0.0;                    // force of the tip on the tissue before it,
  double tip_mm = 0.0;                   // which it has pushed so far
  double shaft_mm = 0.0;                 // how far the shaft drags the tissue along; < 0 on the way out
  volume::TissueClass organ = volume::TissueClass::air;  // that the tip presses on, or is in,
  double organ_n = 0.0;                                  // and how hard; 0: none
};

// A straight piece of a vein that gives way to pressure.
struct SqueezedVein {
  glm::dvec3 from_lps_mm{0.0}, to_lps_mm{0.0};
  double radius_mm = 0.0;   // at rest, > 0
  double area_share = 1.0;  // of its area that is left, 0 to 1
};

// An organ that is pressed goes along and turns as a whole.
struct PushedOrgan {
  glm::dvec3 middle_lps_mm{0.0};
  double radius_mm = 0.0;     // of the ball of its volume, > 0
  glm::dvec3 at_lps_mm{0.0};  // at rest, where it is pressed,
  glm::dvec3 force_n{0.0};    // and how
};

struct Breath {
  BreathRegion region;
  glm::dvec3 amount_mm{0.0};         // now: to the right, to the front, downwards, where it is most
  const CavityWall* wall = nullptr;  // under which organs slide; null: they come to rest within the outer third
};

constexpr int kMostPresses = 2, kMostVeins = 11;

struct Causes {
  std::span<const SkinPress> presses{};   // at most kMostPresses (CHECKed)
  std::optional<NeedleDrag> needle{};     //
  std::span<const SqueezedVein> veins{};  // at most kMostVeins (CHECKed)
  std::optional<Breath> breath{};         // nothing where the patient does not breathe
  std::optional<PushedOrgan> organ{};     // then one press less (CHECKed)
};

// What does not move anything makes no source. Bounded, so that no tissue is folded: a press counts no deeper than
// 0.6 of the head's radius and of the bone's depth, and less over bone just under the skin.
Displacement displacement_of(const Causes& causes) noexcept;

// The same but for what probes do.
Displacement without_presses(const Displacement& displacement) noexcept;

int count_sources(const Displacement& displacement) noexcept;

// x of X, in mm.
glm::dvec3 displaced(const Displacement& displacement, const glm::dvec3& rest_lps_mm) noexcept;
// Of many, as many as there is room for (CHECKed): the same bits, sooner.
void displaced(const Displacement& displacement, std::span<const glm::dvec3> rest_lps_mm,
               std::span<glm::dvec3> now_lps_mm) noexcept;

// X of x. Fixed-point steps first, then Newton's; the defaults are right to 0.001 mm without bone, to 0.3 mm
// anywhere (docs/decisions/0023).
struct InverseSteps {
  int fixed_point = 3, newton = 2;
};
glm::dvec3 rest_of(const Displacement& displacement, const glm::dvec3& at_lps_mm, InverseSteps steps = {}) noexcept;
// Of many, as many as there is room for (CHECKed), by fixed-point steps alone: the same bits, sooner.
void rest_of(const Displacement& displacement, std::span<const glm::dvec3> at_lps_mm, int fixed_point_steps,
             std::span<glm::dvec3> rest_lps_mm) noexcept;

// How much larger a small piece of tissue is than at rest; > 0 unless it is folded.
double volume_ratio(const Displacement& displacement, const glm::dvec3& rest_lps_mm) noexcept;

// A ball pressed into tissue that ends in bone, as displacement_of takes it: the disk whose pressure puts the skin
// on the ball in the middle and at the edge. Without bone that is Hertz' own.
struct PressedDisk {
  double depth_mm = 0.0;   // after the bounds
  double radius_mm = 0.0;  // of the contact; √(R δ) without bone
  double bone_mm = 0.0;    // 0: none
  double amount_mm = 0.0;  // times the potential of a disk
};
PressedDisk pressed_disk(const SkinPress& press) noexcept;

// N, for tissue of modulus G. That over bone it rises as touch's force does is tested, not built in.
double force_n(const PressedDisk& disk, double shear_n_mm2) noexcept;

// N/mm² of hydrostatic pressure that a press adds at a place at rest.
double pressure_n_mm2(const SkinPress& press, const glm::dvec3& rest_lps_mm, double shear_n_mm2) noexcept;

// What is left of a vein's area under pressure from outside, above `inside` of its blood: the thin tube's law of
// collapse (Shapiro, J. Biomech. Eng. 99, 1977, recalled: p_inside − p_outside = −K (share^(−3/2) − 1)), K by
// design.
double vein_area_share(double outside_n_mm2, double inside_n_mm2) noexcept;

}  // namespace seldinger::tissue
