#include "sim/haptics/needle_law.h"

#include <algorithm>
#include <limits>

#include "sim/base/check.h"
#include "sim/base/exact_math.h"

namespace seldinger::haptics {
namespace {

// Tissue moves along with each mm of shaft: 2 π G / ln(2 L / a) with G 4.5 kPa, L 80 mm, a 0.36 mm (haptics.md §2.1
// for the formula; G by design).
constexpr double kShaftStiffnessNMm2 = 0.005;
// The shaft takes no more than this share of the device's stiffness, so that the tip's part stays palpable
// (design).
constexpr double kShaftShare = 0.4;
// A capsule's spring is R (a q + (1 − a) q²) with q = dent / full dent: soft at touch, stiffest at rupture
// (design).
constexpr double kCapsuleLinearPart = 0.25;
constexpr double kCapsuleSteepest = 2.0 - kCapsuleLinearPart;  // its steepest slope, in R / full dent
// The fall after a rupture takes 5-20 ms (haptics.md §2.2, item 1).
constexpr double kRuptureFallS = 0.008;
// The damper's most: at a hand's jerk it must not be a step of its own (design; the goal of 0.15 N a tick).
constexpr double kMostDampingN = 0.1;
// Relaxation: to this part of what slides or cuts, with this time (design; haptics.md §2.2 gives 5-20 s).
constexpr double kRelaxedPart = 0.65, kRelaxationS = 10.0;

double capsule_force_n(double dent_mm, double full_dent_mm, double rupture_n) {
  const double q = dent_mm / full_dent_mm;
  return rupture_n * q * (kCapsuleLinearPart + (1.0 - kCapsuleLinearPart) * q);
}

}  // namespace

NeedleLaw::NeedleLaw(std::span<const NeedleLayer> layers, const NeedleSettings& settings)
    : settings_(settings), count_(layers.size()) {
  CHECK(count_ > 0 && count_ <= kMostNeedleLayers);
  CHECK(settings.tick_s > 0.0 && settings.stiffness_n_mm > 0.0 && settings.damper_cutoff_hz > 0.0);
  constexpr double kTwoPi = 6.283185307179586;
  damper_share_ = 1.0 - base::exact_exp(-kTwoPi * settings.damper_cutoff_hz * settings.tick_s);
  rupture_keep_ = base::exact_exp(-settings.tick_s / kRuptureFallS);
  damper_time_s_ = settings.damping_n_s_mm / settings.stiffness_n_mm;
  for (std::size_t i = 0; i < count_; ++i) {
    const auto& [start_mm, tissue] = layers[i];
    CHECK(i == 0 || start_mm > layers[i - 1].start_mm);
    Layer& layer = layers_[i];
    layer.start_mm = start_mm;
    layer.slope_n_mm = tissue.slope_n_mm;
    const double left_n_mm =
        settings.stiffness_n_mm - shaft_stiffness_n_mm(start_mm - layers[0].start_mm);  // beside the shaft
    if (tissue.impenetrable) {
      layer.wall_n_mm = left_n_mm;
      continue;
    }
    layer.tip_stiffness_n_mm = std::min(tissue.tip_stiffness_n_mm, settings.stiffness_n_mm * (1.0 - kShaftShare));
    // The line is measured at the hub's depth; the shaft in tissue is shorter by the tip's reach = limit /
    // stiffness.
    layer.tip_limit_n = tissue.intercept_n / (1.0 - tissue.slope_n_mm / layer.tip_stiffness_n_mm);
    layer.tip_reach_mm = layer.tip_limit_n / layer.tip_stiffness_n_mm;
    layer.rupture_n = tissue.rupture_n;
    layer.dent_mm = std::max(tissue.dent_mm, kCapsuleSteepest * tissue.rupture_n / left_n_mm);
  }
  reset();
}

void NeedleLaw::reset() noexcept {
  opened_ = 0;
  anchor_mm_ = layers_[0].start_mm;
  shaft_n_ = rupture_n_ = damper_n_ = last_depth_mm_ = last_elastic_n_ = 0.0;
  started_ = false;
}

double NeedleLaw::next_start_mm() const noexcept {
  return opened_ < count_ ? layers_[opened_].start_mm : std::numeric_limits<double>::infinity();
}

double NeedleLaw::inserted_mm(double depth_mm) const noexcept {
  return opened_ == 0 ? 0.0 : std::max(0.0, std::min(anchor_mm_, depth_mm) - layers_[0].start_mm);
}

double NeedleLaw::friction_limit_n(double length_mm) const noexcept {
  const double tip_mm = layers_[0].start_mm + length_mm;
  double limit_n = 0.0;
  for (std::size_t i = 0; i < opened_ && layers_[i].start_mm < tip_mm; ++i) {
    const double end_mm = i + 1 < count_ ? std::min(layers_[i + 1].start_mm, tip_mm) : tip_mm;
    limit_n += layers_[i].slope_n_mm * (end_mm - layers_[i].start_mm);
  }
  return limit_n;
}

double NeedleLaw::shaft_stiffness_n_mm(double length_mm) const noexcept {
  return std::min(kShaftStiffnessNMm2 * length_mm, kShaftShare * settings_.stiffness_n_mm);
}

double NeedleLaw::tip_force_n(double depth_mm) const noexcept {
  const double stretch_mm = depth_mm - anchor_mm_;
  if (!(stretch_mm > 0.0)) return 0.0;
  double reach_mm = 0.0, force_n = 0.0;
  if (opened_ > 0) {
    const Layer& in = layers_[opened_ - 1];
    reach_mm = in.tip_reach_mm;
    force_n = stretch_mm < reach_mm ? in.tip_stiffness_n_mm * stretch_mm : in.tip_limit_n;
  }
  if (anchor_mm_ < next_start_mm() || stretch_mm <= reach_mm) return force_n;
  const Layer& next = layers_[opened_];
  const double dent_mm = stretch_mm - reach_mm;
  return force_n +
         (next.wall_n_mm > 0.0 ? next.wall_n_mm * dent_mm : capsule_force_n(dent_mm, next.dent_mm, next.rupture_n));
}

// The wall follows a tip that pushes harder than cutting takes, as far as the next capsule.
void NeedleLaw::cut(double depth_mm) noexcept {
  const double wall_mm = depth_mm - layers_[opened_ - 1].tip_reach_mm;
  if (wall_mm > anchor_mm_) anchor_mm_ = std::min(wall_mm, next_start_mm());
}

void NeedleLaw::relax(double limit_n, double stiffness_n_mm, double depth_mm) noexcept {
  const double part = settings_.tick_s / kRelaxationS;
  if (stiffness_n_mm > 0.0 && shaft_n_ > kRelaxedPart * limit_n)
    shaft_n_ -= part * (shaft_n_ - kRelaxedPart * limit_n);
  if (stiffness_n_mm > 0.0 && shaft_n_ < -kRelaxedPart * limit_n)
    shaft_n_ -= part * (shaft_n_ + kRelaxedPart * limit_n);
  if (anchor_mm_ < next_start_mm()) {
    const double excess_mm = depth_mm - anchor_mm_ - kRelaxedPart * layers_[opened_ - 1].tip_reach_mm;
    if (excess_mm > 0.0) anchor_mm_ = std::min(anchor_mm_ + part * excess_mm, next_start_mm());
  }
}

NeedleForce NeedleLaw::advance(double depth_mm) noexcept {
  const double moved_mm = started_ ? depth_mm - last_depth_mm_ : 0.0;
  started_ = true;
  last_depth_mm_ = depth_mm;
  NeedleForce force;
  if (opened_ > 0) cut(depth_mm);
  force.tip_n = tip_force_n(depth_mm);

  if (opened_ < count_ && anchor_mm_ >= next_start_mm() && layers_[opened_].wall_n_mm == 0.0 &&
      depth_mm > anchor_mm_ && force.tip_n >= layers_[opened_].rupture_n) {
    force.ruptured = true;
    const double held_n = force.tip_n + shaft_n_;
    ++opened_;
    cut(depth_mm);
    force.tip_n = tip_force_n(depth_mm);
    // The tissue that was pushed in slides back along the shaft.
    shaft_n_ = friction_limit_n(inserted_mm(depth_mm));
    rupture_n_ += held_n - force.tip_n - shaft_n_;
  } else {
    const double length_mm = inserted_mm(depth_mm);
    const double limit_n = friction_limit_n(length_mm), stiffness_n_mm = shaft_stiffness_n_mm(length_mm);
    shaft_n_ = std::clamp(shaft_n_ + stiffness_n_mm * moved_mm, -limit_n, limit_n);
    if (settings_.relaxation && opened_ > 0) relax(limit_n, stiffness_n_mm, depth_mm);
  }

  // On how fast the springs load: zero while the needle cuts and slides, whatever its speed.
  const double elastic_n = force.tip_n + shaft_n_;
  const double rate_n_s = force.ruptured ? 0.0 : (elastic_n - last_elastic_n_) / settings_.tick_s;
  last_elastic_n_ = elastic_n;
  const double damping_n = std::clamp(damper_time_s_ * rate_n_s, -kMostDampingN, kMostDampingN);
  damper_n_ += damper_share_ * (damping_n - damper_n_);

  force.shaft_n = shaft_n_;
  force.rupture_n = rupture_n_;
  force.damper_n = damper_n_;
  force.axial_n = elastic_n + rupture_n_ + damper_n_;
  // A surface that was only touched never pulls.
  if (opened_ == 0) force.axial_n = std::max(0.0, force.axial_n);
  rupture_n_ *= rupture_keep_;
  return force;
}

}  // namespace seldinger::haptics
