// The force along a needle's axis, tick by tick (docs/decisions/0016). Capsules are springs that
// rupture; the tip meets an elastic wall that it pushes on once the wall's force reaches what cutting takes (an
// elasto-plastic "tracking wall", Alamilla 2018); the shaft drags the tissue along and slides once friction's limit
// is reached (Dahl's model of order 0). Nothing depends on speed but a damper on how fast these springs load, so a
// force is the same at any speed and stays at rest; where it is asked for, what is held relaxes, and a capsule
// opens at less the faster it is pushed (docs/decisions/0088). Out of the track, only friction pulls back; into it
// again, nothing is cut that was cut. In an introducer's tube the shaft slides nearly free. Only + − × ÷, roots and
// exact_log: the same bits everywhere.
#pragma once

#include <cstddef>
#include <span>

#include "sim/haptics/contact/elastic_damper.h"
#include "sim/haptics/contact/stiffness_bound.h"
#include "sim/haptics/needle/needle_tissue.h"

namespace seldinger::haptics {

// Tissue along the needle's path, from start_mm of depth to the next layer's start.
struct NeedleLayer {
  double start_mm;
  NeedleTissue tissue;
};

// Tissue moves along with each mm of shaft: 2 π G / ln(2 L / a) with G 4.5 kPa, L 80 mm, a 0.36 mm (a rod in an
// elastic medium; G is our judgement).
inline constexpr double kShaftStiffnessNMm2 = 0.005;

// Of what opens by speed: the rows' own speed (the thesis' 500 mm/min), and where the law ends.
inline constexpr double kRowSpeedMmS = 500.0 / 60.0, kSlowestMmS = 1.0, kFastestMmS = 100.0;

struct NeedleSettings {
  double tick_s = 0.001;
  double damping_n_s_mm = kWallDampingNSMm;
  // All springs that act at once add up to no more; softer springs give way further for the same force.
  double stiffness_n_mm = stiffness_bound_n_mm(kWallDampingNSMm, 0.001, 0.001) / kStiffnessMargin;
  bool relaxation = false;        // of tissue held in a stretch
  bool rupture_by_speed = false;  // a capsule's row is that of kRowSpeedMmS
};

// The same by a case's law of touch.
NeedleSettings of_law(NeedleSettings settings, cases::TouchLaw law) noexcept;

// What a needle's way has left behind: all that must be kept from tick to tick. A new one: nothing touched yet.
struct NeedleTrack {
  std::size_t opened = 0;  // layers entered; the tip is in the last of them
  double cut_mm = 0.0;     // where the tip's wall stands: how far along the undeformed path tissue is cut
  double shaft_n = 0.0, falling_n = 0.0, damper_n = 0.0;
  double last_depth_mm = 0.0, last_elastic_n = 0.0;
  double speed_mm_s = 0.0;  // of the tip along the path, smoothed
  double sheath_mm = 0.0;   // from the path's start on, of the needle that slides in an introducer's tube; 0: none
  bool begun = false;       // false: last_* say nothing yet
  bool exchanged = false;   // another needle since the last tick: what the last one held falls
};

// Newtons; > 0 resists insertion.
struct NeedleForce {
  double axial_n = 0.0;  // what the hand feels: the sum of the following
  double tip_n = 0.0;    // ≥ 0
  double shaft_n = 0.0;
  double falling_n = 0.0;  // what is left of the fall after a rupture; decays within some 50 ms
  double damper_n = 0.0;
  double capsule_n = 0.0;  // what of tip_n is on the capsule that is to open next, ≥ 0
  bool ruptured = false;   // the tip entered a layer in this tick: the declared event
};

class NeedleLaw {
 public:
  // CHECKs that tick and stiffness are > 0 and damping ≥ 0.
  explicit NeedleLaw(const NeedleSettings& settings);

  // One tick: the tip is now at depth_mm along the path. `path`: by rising start; it may change from tick to tick
  // but for the layers that the track has entered (CHECKed to be there). Allocates nothing.
  NeedleForce advance(std::span<const NeedleLayer> path, double depth_mm, NeedleTrack& track) const noexcept;

  // How far the shaft, inserted by length_mm, drags the tissue along now, beyond a sheath; < 0 on the way out.
  double dragged_mm(double length_mm, const NeedleTrack& track) const noexcept;

 private:
  struct Tip;  // what the tissue at the tip does

  Tip tip_of(const NeedleTissue& tissue) const noexcept;
  double opens_at_n(const NeedleTissue& tissue, const NeedleTrack& track) const noexcept;
  double shaft_stiffness_n_mm(double length_mm, const NeedleTrack& track) const noexcept;
  double tip_force_n(std::span<const NeedleLayer> path, double depth_mm, const NeedleTrack& track) const noexcept;
  void cut(std::span<const NeedleLayer> path, double depth_mm, NeedleTrack& track) const noexcept;
  void slide(std::span<const NeedleLayer> path, double depth_mm, NeedleTrack& track) const noexcept;

  NeedleSettings settings_;
  ElasticDamper damper_;
  double falling_share_, speed_share_, capsule_steepest_;
};

// A capsule's force at a speed, in that of its row: 1 at kRowSpeedMmS, falling with the speed's logarithm.
double rupture_share(double speed_mm_s) noexcept;

// How much of the needle is in tissue, mm.
double inserted_mm(std::span<const NeedleLayer> path, double depth_mm, const NeedleTrack& track) noexcept;

}  // namespace seldinger::haptics
