// Two hands without force feedback: what a mouse, a gamepad or a 3-D mouse wants (HandIntent) becomes the poses of
// needle and probe. One hand speaks at a time, to the tool that is held; the other tool stays. Nothing moves faster
// than a hand does: what is wanted beyond that follows within kPendingS, and what is more than that is lost.
// Pure: no clock, lock or allocation; may run on the servo's thread.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "sim/case/form/mesh_index.h"
#include "sim/case/inputs.h"
#include "sim/devices/hands/hand_intent.h"
#include "sim/devices/hands/needle_in_hand.h"
#include "sim/devices/hands/probe_on_skin.h"

namespace seldinger::devices {

// mm/s and rad/s of a hand: in the air and over skin as the virtual device's; in tissue and pressing, slow
// (design).
inline constexpr double kSlideMmS = 400.0, kInsertMmS = 60.0, kPressMmS = 60.0, kTurnRadS = 3.0;
inline constexpr double kPendingS = 0.25;

// A mouse cannot push back. So a tool that is pushed out with force F goes 1 / (1 + F / F0) of the way it is wanted
// to: at F0 a notch does half. It is never turned round by a force, and it never sticks for good: more notches go
// on, and where tissue gives way they are felt to go further. (A threshold that stalls until more notches come was
// the other choice: below it a hand would feel nothing, above it a jump.)
inline constexpr double kNeedleHalfN = 1.0, kProbeHalfN = 5.0;  // of a needle's plateau, and a probe's usual press
// The share of a wanted way along the axis that is gone. axial_force_n > 0 pushes the tool out; what pushes the way
// it goes counts as none. No number: 0, it stands.
double share_against(double axial_force_n, double wanted_mm, double half_n) noexcept;

struct HandsStart {
  cases::ToolPose needle, probe;
};

// Where a trainee starts well. The needle's tip is kStartAboveMm short of the entry, on the line to the target. In
// plane the probe stands kProbeBesideMm from the entry on the target's side, its plane holding both, its side
// pointing away from the needle; out of plane there too, its plane across the needle's and through the target.
// `mirrored`: a left hand's: its side turns over, and of a line straight down the probe is on the other side.
inline constexpr double kStartAboveMm = 15.0, kProbeBesideMm = 35.0;
HandsStart start_over(const cases::MeshIndex& skin, const glm::dvec3& entry_lps_mm, const glm::dvec3& target_lps_mm,
                      bool in_plane, bool mirrored);

// A needle guide. On the probe: in its plane, leaving beside the face at offset_mm from its centre, on the side
// where the needle is when the guide is taken up, at angle_deg to the probe's axis and towards it. In space: from a
// place on the skin to what is aimed at.
struct ProbeGuide {
  double offset_mm = 35.0;  // > 0
  double angle_deg = 40.0;  // 0 < angle < 90
};
struct LineGuide {
  glm::dvec3 entry_lps_mm{0.0}, aim_lps_mm{0.0};
};

struct HandsSettings {
  double needle_length_mm = 200.0;
  bool has_guide = true;
  bool has_probe = true;            // else there is nothing to swap the needle for
  std::optional<LineGuide> line{};  // takes the place of `probe_guide`
  ProbeGuide probe_guide{};
};

// What pushed the tools in the last tick, > 0 out of the body.
struct AxialForces {
  double needle_n = 0.0, probe_n = 0.0;
};

class Hands {
 public:
  // The skin must outlive this.
  Hands(const cases::MeshIndex& skin, const HandsStart& start, const HandsSettings& settings = {});

  void advance(const HandIntent& intent, const AxialForces& forces, double elapsed_s) noexcept;

  const cases::ToolPose& needle() const noexcept { return needle_.pose(); }
  const cases::ToolPose& probe() const noexcept { return probe_.pose(); }
  bool fire() const noexcept { return fire_; }
  bool frozen() const noexcept { return frozen_; }
  HeldTool held() const noexcept { return held_; }
  const cases::ToolPose& held_pose() const noexcept { return held_ == HeldTool::needle ? needle() : probe(); }
  bool needle_inserted() const noexcept { return needle_.inserted(); }
  double inserted_mm() const noexcept { return needle_.inserted_mm(); }
  double press_mm() const noexcept { return probe_.press_mm(); }
  bool guided() const noexcept { return guided_; }                       // the needle goes in the guide, or to it
  bool in_guide() const noexcept { return in_guide_; }                   // it is on the guide's line
  std::uint32_t guides_asked() const noexcept { return guides_asked_; }  // in vain, too
  // The probe's, while it is taken up: its offset is negative where it leaves on the side that `side` points away
  // from. Nothing: none is, or it is in space.
  std::optional<ProbeGuide> guide_on_probe() const noexcept;
  bool returning() const noexcept { return returning_; }  // to the start; any move of the hand ends that
  // A needle in tissue and in the probe's guide holds the probe where it is.
  bool probe_held() const noexcept { return in_guide_ && on_probe() && needle_.inserted(); }

  // Poses, trigger and frozen picture.
  void say(cases::Inputs& inputs) const noexcept;

  // A guide that is on lets go.
  void set_guide(const ProbeGuide& guide) noexcept;
  void set_guide(const LineGuide& guide) noexcept;
  // What is still wanted of the tools is lost, and they stay where they are.
  void let_go() noexcept;
  // From here on as if the hands had been there: poses that another device left.
  void take_over(const HandsStart& at) noexcept;

 private:
  struct Line {
    glm::dvec3 from_lps_mm, along;  // unit
    glm::dvec3 side;
  };
  bool on_probe() const noexcept { return !settings_.line; }
  Line guide_line() const noexcept;
  void press_buttons(const HandIntent& intent) noexcept;
  void take_up(const HandIntent& intent) noexcept;
  void move_needle(const AxialForces& forces, double elapsed_s) noexcept;
  void move_probe(const AxialForces& forces, double elapsed_s) noexcept;
  void follow_guide(double elapsed_s) noexcept;
  void go_back(double elapsed_s) noexcept;

  const cases::MeshIndex* skin_;
  HandsStart start_;
  HandsSettings settings_;
  NeedleInHand needle_;
  ProbeOnSkin probe_, probe_start_;
  HeldTool held_ = HeldTool::needle;
  bool fire_ = false, frozen_ = false, guided_ = false, in_guide_ = false, returning_ = false, keep_tilt_ = false;
  glm::dvec3 pending_slide_mm_{0.0}, pending_turn_rad_{0.0};
  double pending_advance_mm_ = 0.0;
  std::uint32_t guides_asked_ = 0;
  double guide_side_ = -1.0;     // 1: the guide is where the probe's side points
  double along_guide_mm_ = 0.0;  // of the tip, from where the guide's line begins
};

}  // namespace seldinger::devices
