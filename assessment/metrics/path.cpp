// The tip's way.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "assessment/metrics/tables.h"
#include "assessment/signals/signals.h"

namespace seldinger::assessment {
namespace {

constexpr double kMinStraightMm = 5.0;  // assessment.md §8, path_inefficiency
constexpr double kExcursionMm = 5.0;    // clinical.md: jiggling is taught
constexpr double kSwingMm = 0.5;        // the shaft swings when its tip does by this

double length_mm(const Step& step) {
  return glm::distance(step.from_lps_mm, step.to_lps_mm);
}

// Of a step's length, clipped at the skin.
double share_in_tissue(const Step& step) {
  const double from_mm = step.depth_from_mm, to_mm = step.depth_to_mm;
  if (from_mm > 0.0 && to_mm > 0.0) return 1.0;
  if (from_mm <= 0.0 && to_mm <= 0.0) return 0.0;
  return std::max(from_mm, to_mm) / std::abs(to_mm - from_mm);
}

Measured path_tip(const Signals& signals) {
  double path_mm = 0.0;
  for (const Step& step : signals.steps)
    if (step.moving) path_mm += length_mm(step);
  return Measured::of(path_mm);
}

Measured path_in_tissue(const Signals& signals) {
  double path_mm = 0.0;
  for (const Step& step : signals.steps)
    if (step.moving) path_mm += length_mm(step) * share_in_tissue(step);
  return Measured::of(path_mm);
}

// What to-and-fro along the needle of less than kExcursionMm adds to the way. Turning points are kept until a swing
// between two of them is no greater than those around it (rainflow counting, ASTM E1049); then it is a swing there
// and back.
class Excursions {
 public:
  void move_by(double along_mm) {
    at_mm_ += along_mm;
    if (turns_mm_.empty()) turns_mm_.push_back(0.0);
    const std::size_t count = turns_mm_.size();
    // The last point moves along as long as the motion keeps its sense.
    const bool same_sense =
        count > 1 && (turns_mm_[count - 1] - turns_mm_[count - 2]) * (at_mm_ - turns_mm_[count - 1]) >= 0.0;
    if (same_sense)
      turns_mm_.back() = at_mm_;
    else if (at_mm_ != turns_mm_.back())
      turns_mm_.push_back(at_mm_);
    while (turns_mm_.size() >= 4) {
      const std::size_t n = turns_mm_.size();
      const double last = std::abs(turns_mm_[n - 1] - turns_mm_[n - 2]);
      const double middle = std::abs(turns_mm_[n - 2] - turns_mm_[n - 3]);
      const double before = std::abs(turns_mm_[n - 3] - turns_mm_[n - 4]);
      if (middle > last || middle > before) break;
      if (middle < kExcursionMm) excess_mm_ += 2.0 * middle;
      turns_mm_.erase(turns_mm_.end() - 3, turns_mm_.end() - 1);
    }
  }
  // With what is not closed at the end: a last turn back by less is an excursion, too.
  double excess_mm() const {
    double excess_mm = excess_mm_;
    std::vector<double> turns_mm = turns_mm_;
    while (turns_mm.size() >= 3) {
      const std::size_t n = turns_mm.size();
      const double last = std::abs(turns_mm[n - 1] - turns_mm[n - 2]);
      const double before = std::abs(turns_mm[n - 2] - turns_mm[n - 3]);
      if (std::min(last, before) >= kExcursionMm) break;
      excess_mm += 2.0 * std::min(last, before);
      turns_mm.erase(turns_mm.end() - 2);
    }
    return excess_mm;
  }

 private:
  double at_mm_ = 0.0, excess_mm_ = 0.0;
  std::vector<double> turns_mm_;
};

Measured path_inefficiency(const Signals& signals) {
  const cases::SkinPassage& skin = signals.passages.back();
  if (!skin.in_body) return Measured::none("not_in_tissue_at_the_end");
  const double straight_mm = glm::distance(skin.entry_lps_mm, signals.poses.back().tip_at_rest_lps_mm());
  if (!(straight_mm >= kMinStraightMm)) return Measured::none("under_5_mm_from_the_skin");
  double path_mm = 0.0;
  Excursions excursions;
  for (const Step& step : signals.steps) {
    const double share = step.moving ? share_in_tissue(step) : 0.0;
    if (!(share > 0.0)) continue;
    path_mm += length_mm(step) * share;
    excursions.move_by(glm::dot(step.to_lps_mm - step.from_lps_mm, step.needle_direction) * share);
  }
  return Measured::of(100.0 * ((path_mm - excursions.excess_mm()) / straight_mm - 1.0));
}

// Between skin entry and tip, triangle by triangle: what is swept to and fro cancels until the tip is kSwingMm
// beside where the needle last pointed.
class Sweep {
 public:
  void enter(const glm::dvec3& entry, const glm::dvec3& tip) {
    entry_ = entry;
    last_ = pointed_ = tip - entry;
  }
  void move_to(const glm::dvec3& tip) {
    const glm::dvec3 now = tip - entry_;
    pending_mm2_ += 0.5 * glm::cross(last_, now);
    last_ = now;
    const double pointed_mm = glm::length(pointed_);
    if (!(pointed_mm > 0.0)) {
      pointed_ = now;
    } else if (glm::length(glm::cross(pointed_, now)) >= kSwingMm * pointed_mm) {
      close();
      pointed_ = now;
    }
  }
  void close() {
    area_mm2_ += glm::length(pending_mm2_);
    pending_mm2_ = glm::dvec3(0.0);
  }
  const glm::dvec3& entry() const { return entry_; }
  double area_mm2() const { return area_mm2_; }

 private:
  double area_mm2_ = 0.0;
  glm::dvec3 entry_{0.0}, last_{0.0}, pointed_{0.0};
  glm::dvec3 pending_mm2_{0.0};  // as a vector, across what was swept
};

Measured swept_area(const Signals& signals) {
  Sweep sweep;
  bool inside = false;
  for (std::size_t i = 0; i < signals.poses.size(); ++i) {
    const cases::SkinPassage& skin = signals.passages[i];
    const bool goes_on = inside && skin.in_body && !signals.gap(i - 1) && skin.entry_lps_mm == sweep.entry();
    if (inside && !goes_on) sweep.close();
    if (goes_on) sweep.move_to(signals.poses[i].tip_at_rest_lps_mm());
    if (skin.in_body && !goes_on) sweep.enter(skin.entry_lps_mm, signals.poses[i].tip_at_rest_lps_mm());
    inside = skin.in_body;
  }
  sweep.close();
  return Measured::of(sweep.area_mm2());
}

// Movements: runs of moving steps; each counts by how long it lasted.
Measured ldlj(const Signals& signals) {
  double sum = 0.0, total_s = 0.0;
  std::vector<glm::dvec3> positions;
  const auto close = [&] {
    const auto one = log_dimensionless_jerk(positions, kMotionRateHz);
    const double length_s = static_cast<double>(positions.size()) / kMotionRateHz;
    if (one) sum += *one * length_s, total_s += length_s;
    positions.clear();
  };
  for (const Step& step : signals.steps) {
    const bool whole = step.length_s > 1.0 / kMotionRateHz - 1e-9;
    if (!step.moving || step.first || !whole) close();
    if (!step.moving || !whole) continue;
    if (positions.empty()) positions.push_back(step.from_lps_mm);
    positions.push_back(step.to_lps_mm);
  }
  close();
  if (!(total_s > 0.0)) return Measured::none("no_movement_of_5_mm_s");
  return Measured::of(sum / total_s);
}

constexpr MetricInfo kPathMetrics[] = {
    {"path_tip", 2, "mm", "Tip path", Group::path, Direction::lower_is_better, kMotion,
     "Length of the tip's way while it moved: resampled to 100 Hz, low-passed at 10 Hz (zero-phase 4th-order "
     "Butterworth), at 3 mm/s or more for at least 0.2 s; gaps over 0.25 s are not bridged. One pose: 0.",
     kJohnson, &path_tip},
    {"path_in_tissue", 1, "mm", "Tip path in tissue", Group::path, Direction::lower_is_better, kMotion | kSkin,
     "The part of path_tip below the skin; what goes through the skin is clipped at it.", "Perk Tutor's TissuePath",
     &path_in_tissue},
    {"path_inefficiency", 1, "%", "Detour in tissue", Group::path, Direction::lower_is_better, kMotion | kSkin,
     "How much longer path_in_tissue was than the straight line from the last skin entry to the tip at the end; to "
     "and "
     "fro along the needle by under 5 mm is left out (jiggling is taught). Null: not_in_tissue_at_the_end, "
     "under_5_mm_from_the_skin.",
     "Perk Tutor's PathInefficiency, in tissue", &path_inefficiency},
    {"swept_area", 1, "mm²", "Area swept by shaft", Group::safety, Direction::lower_is_better, kMotion | kSkin,
     "Area that the needle between skin entry and tip swept, as a fan of triangles; to and fro by under 0.5 mm at "
     "the "
     "tip, and pushing, sweep nothing.",
     "potential tissue damage: Perk Tutor's TissueDamage; Keri et al. 2015", &swept_area},
    {"ldlj", 1, "1", "Smoothness", Group::path, Direction::higher_is_better, kMotion,
     "Log dimensionless jerk, −ln(T³/v_peak² ∫‖jerk‖² dt), of each movement (a run that path_tip counts), averaged "
     "over "
     "their times; nearer to 0 is smoother, a single minimum-jerk reach has −5.3 from start to end. Movements "
     "under 5 "
     "mm/s are left out. Null: no_movement_of_5_mm_s.",
     "Balasubramanian et al., IEEE Trans. Biomed. Eng. 59 (2012) 2126", &ldlj},
};

}  // namespace

std::span<const MetricInfo> path_metrics() {
  return kPathMetrics;
}

}  // namespace seldinger::assessment
