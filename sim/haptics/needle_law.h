// The force along a needle's axis, tick by tick (design.md; knowledge/haptics.md §2.2). Capsules are springs that
// rupture; the tip meets an elastic wall that it pushes on once the wall's force reaches what cutting takes (an
// elasto-plastic "tracking wall", Alamilla 2018); the shaft drags the tissue along and slides once friction's limit
// is reached (Dahl's model of order 0). Nothing depends on speed but a damper on how fast these springs load, so a
// force is the same at any speed and stays at rest. Out of the track, only friction pulls back; into it again,
// nothing is cut that was cut. Only + − × ÷: the same bits everywhere.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "sim/haptics/needle_tissue.h"
#include "sim/haptics/stiffness_bound.h"

namespace seldinger::haptics {

// Tissue from start_mm of depth along the path, to the next layer's start.
struct NeedleLayer {
  double start_mm;
  NeedleTissue tissue;
};

inline constexpr std::size_t kMostNeedleLayers = 16;

struct NeedleSettings {
  double tick_s = 0.001;
  double damping_n_s_mm = 0.001;    // of the damper, at the full stiffness: 1 N s/m (haptics.md §0, item 4)
  double damper_cutoff_hz = 100.0;  // low-pass of the damper (haptics.md §3.2)
  // All springs that act at once add up to no more; softer springs give way further for the same force.
  double stiffness_n_mm = stiffness_bound_n_mm(0.001, 0.001, 0.001) / kStiffnessMargin;
  bool relaxation = false;  // of tissue held in a stretch
};

// Newtons; > 0 resists insertion.
struct NeedleForce {
  double axial_n = 0.0;  // what the hand feels: the sum of the following
  double tip_n = 0.0;    // ≥ 0
  double shaft_n = 0.0;
  double rupture_n = 0.0;  // what is left of the fall after a rupture; decays within 40 ms
  double damper_n = 0.0;
  bool ruptured = false;  // in this tick: the declared event
};

class NeedleLaw {
 public:
  // `layers`: 1 to kMostNeedleLayers, by rising start; stiffness, tick and cutoff > 0 (CHECKed).
  NeedleLaw(std::span<const NeedleLayer> layers, const NeedleSettings& settings);

  // One tick: the tip is now at depth_mm along the path. Allocates nothing.
  NeedleForce advance(double depth_mm) noexcept;

  // As before the first touch: a new track.
  void reset() noexcept;

  // How much of the needle is in tissue, mm.
  double inserted_mm(double depth_mm) const noexcept;
  // Capsules opened so far.
  std::size_t ruptures() const noexcept { return opened_; }

 private:
  struct Layer {
    double start_mm, slope_n_mm;
    double tip_stiffness_n_mm, tip_limit_n, tip_reach_mm;  // reach: the stretch at which the wall is cut
    double rupture_n, dent_mm;
    double wall_n_mm;  // > 0: impenetrable
  };

  double next_start_mm() const noexcept;
  double tip_force_n(double depth_mm) const noexcept;
  double friction_limit_n(double length_mm) const noexcept;
  double shaft_stiffness_n_mm(double length_mm) const noexcept;
  void cut(double depth_mm) noexcept;
  void relax(double limit_n, double stiffness_n_mm, double depth_mm) noexcept;

  NeedleSettings settings_;
  std::array<Layer, kMostNeedleLayers> layers_{};
  std::size_t count_;
  double damper_share_, rupture_keep_, damper_time_s_;

  // What changes from tick to tick.
  std::size_t opened_ = 0;  // the tip is in layer opened_ − 1
  double anchor_mm_ = 0.0;  // where the tip's wall stands: the deepest cut
  double shaft_n_ = 0.0, rupture_n_ = 0.0, damper_n_ = 0.0;
  double last_depth_mm_ = 0.0, last_elastic_n_ = 0.0;
  bool started_ = false;
};

}  // namespace seldinger::haptics
