// The tip's way.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <vector>

#include "assessment/metrics/tables.h"
#include "assessment/signals/signals.h"
#include "assessment/signals/smoothness.h"

namespace seldinger::assessment {
namespace {

constexpr double kMinStraightMm = 5.0;  // for path_inefficiency: our judgement
constexpr double kExcursionMm = 5.0;    // docs/clinical.md: jiggling is taught
constexpr double kSwingMm = 0.5;        // the shaft swings when its tip does by this

Measured path_tip(const Signals& signals) {
  double path_mm = 0.0;
  for (const Stretch& stretch : stretches_of(signals.way)) path_mm += length_mm(stretch.points_mm);
  return Measured::of(path_mm);
}

Measured path_in_tissue(const Signals& signals) {
  double path_mm = 0.0;
  for (const Stretch& stretch : stretches_of(signals.way))
    if (stretch.in_tissue) path_mm += length_mm(stretch.points_mm);
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
  const std::vector<Stretch> stretches = stretches_of(signals.way);
  if (!skin.in_body || stretches.empty() || !stretches.back().in_tissue)
    return Measured::none("not_in_tissue_at_the_end");
  double path_mm = 0.0;
  Excursions excursions;
  // Of the last stretches in tissue, those that a gap parts are joined by a straight line.
  glm::dvec3 entry = skin.entry_lps_mm, last = entry;
  bool joins = false;
  for (const Stretch& stretch : stretches) {
    if (!stretch.in_tissue) {
      joins = false;
      continue;
    }
    if (!joins)
      entry = stretch.points_mm.front();
    else
      path_mm += glm::distance(last, stretch.points_mm.front());
    path_mm += length_mm(stretch.points_mm);
    for (std::size_t i = 1; i < stretch.points_mm.size(); ++i)
      excursions.move_by(glm::dot(stretch.points_mm[i] - stretch.points_mm[i - 1], stretch.needle_directions[i]));
    last = stretch.points_mm.back();
    joins = true;
  }
  const double straight_mm = glm::distance(entry, last);
  if (!(straight_mm >= kMinStraightMm)) return Measured::none("under_5_mm_from_the_skin");
  // However much of it went to and fro, what is left leads from one end to the other.
  return Measured::of(100.0 * (std::max(straight_mm, path_mm - excursions.excess_mm()) / straight_mm - 1.0));
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

// The mean of what `of_one` says of each movement, weighed by how long it lasted.
template <typename OfOne>
Measured of_movements(const Signals& signals, const OfOne& of_one) {
  double sum = 0.0, total_s = 0.0;
  std::size_t at = 0;
  for (const Movement& movement : movements_of(signals)) {
    std::vector<glm::dvec3> positions;
    for (; at < signals.steps.size(); ++at) {
      const Step& step = signals.steps[at];
      const double middle_s = step.t_s + 0.5 * step.length_s;
      if (middle_s < movement.from_s) continue;
      if (middle_s > movement.to_s) break;
      if (step.length_s < 1.0 / kMotionRateHz - 1e-9) continue;  // the piece that is left at an end
      if (positions.empty()) positions.push_back(step.from_lps_mm);
      positions.push_back(step.to_lps_mm);
    }
    const double length_s = static_cast<double>(positions.size()) / kMotionRateHz;
    if (const std::optional<double> one = of_one(positions)) sum += *one * length_s, total_s += length_s;
  }
  if (!(total_s > 0.0)) return Measured::none("no_movement");
  return Measured::of(sum / total_s);
}

Measured ldlj(const Signals& signals) {
  return of_movements(signals, [](const std::vector<glm::dvec3>& positions) {
    return log_dimensionless_jerk(positions, kMotionRateHz);
  });
}

Measured sparc(const Signals& signals) {
  return of_movements(signals, [](const std::vector<glm::dvec3>& positions) {
    std::vector<double> speeds_mm_s;
    for (std::size_t i = 1; i < positions.size(); ++i)
      speeds_mm_s.push_back(glm::distance(positions[i - 1], positions[i]) * kMotionRateHz);
    return spectral_arc_length(speeds_mm_s, kMotionRateHz);
  });
}

constexpr std::uint32_t kOfPath = kAnyPlace | kIdleBefore | kIdleAfter | kOneDarkFrame | kLostSamples;

constexpr MetricInfo kPathMetrics[] = {
    {"path_tip", 3, "mm", "Tip path", Group::path, Direction::lower_is_better, kMotion,
     "Length of the tip's path, however slowly it went: resampled to 100 Hz, low-passed at 10 Hz (zero-phase "
     "4th-order Butterworth), through points at least 0.25 mm apart, so that tremor on one spot adds nothing. The "
     "path is relative to the tissue at rest; breath that moves tissue under a hand at rest, or a needle along "
     "with the tissue, adds nothing. Gaps over 0.25 s are not bridged. One pose: 0.",
     kJohnson, &path_tip, kMedianRatio, kOfPath,
     "1: the filtered path as it was, tremor at rest included; 2: only where it went at 3 mm/s or more for 0.2 "
     "s, so that a slow path was none, and in the room's frame."},
    {"path_in_tissue", 2, "mm", "Tip path in tissue", Group::path, Direction::lower_is_better, kMotion | kSkin,
     "The part of path_tip below the skin; where it crosses the skin it is clipped there.",
     "Perk Tutor's TissuePath", &path_in_tissue, kMedianRatio, kOfPath, "1: the part of path_tip's version 2."},
    {"path_inefficiency", 2, "%", "Detour in tissue", Group::path, Direction::lower_is_better, kMotion | kSkin,
     "How much longer path_in_tissue was than the straight line from where the tip last came through the skin to "
     "where it ended; moving to and fro along the needle by under 5 mm is left out (jiggling is taught), and a gap "
     "in tissue counts as a straight line. Never negative. Null: not_in_tissue_at_the_end, "
     "under_5_mm_from_the_skin.",
     "Perk Tutor's PathInefficiency, in tissue", &path_inefficiency, kMedianRatio, kOfPath,
     "1: of path_in_tissue's version 1: −100 % at less than 3 mm/s."},
    {"swept_area", 1, "mm²", "Area swept by shaft", Group::safety, Direction::lower_is_better, kMotion | kSkin,
     "Area that the needle between skin entry and tip swept, as a fan of triangles; moving to and fro by under 0.5 "
     "mm at the tip, and pushing, sweep nothing.",
     "potential tissue damage: Perk Tutor's TissueDamage; Keri et al. 2015", &swept_area, kMedianRatio,
     kAnyPlace | kAtAnySpeed | kIdleBefore | kIdleAfter | kOneDarkFrame | kLostSamples},
    {"ldlj", 2, "1", "Smoothness", Group::path, Direction::higher_is_better, kMotion,
     "Log dimensionless jerk, −ln(T³/v_peak² ∫‖jerk‖² dt), of each movement, averaged over their times; nearer "
     "to 0 is smoother, a single minimum-jerk reach has −5.3 from start to end. A movement is what lies "
     "between two rests: the tip rests while it comes no further than 0.25 mm in 0.5 s; movements under 1 mm "
     "are left out. Null: no_movement.",
     "Balasubramanian et al., IEEE Trans. Biomed. Eng. 59 (2012) 2126", &ldlj, kMedianInterval,
     kAnyPlace | kIdleAfter | kOneDarkFrame | kNothingIsNothing,
     "1: of runs at 3 mm/s or more for 0.2 s that reached 5 mm/s, so that a slow hand had none."},
    {"sparc", 1, "1", "Spectral smoothness", Group::path, Direction::higher_is_better, kMotion,
     "Spectral arc length (SPARC) of the tip's speed in each movement, as ldlj has them, averaged over their "
     "times: length of the normalised amplitude spectrum up to 10 Hz and above 5 %; nearer to 0 is smoother, a "
     "single minimum-jerk reach has −1.4. Unlike ldlj it does not depend on how long a movement was. Null: "
     "no_movement.",
     "Balasubramanian et al., J. NeuroEng. Rehabil. 12 (2015) 112", &sparc, kMedianInterval,
     kAnyPlace | kIdleAfter | kOneDarkFrame | kNothingIsNothing},
};

}  // namespace

std::span<const MetricInfo> path_metrics() {
  return kPathMetrics;
}

}  // namespace seldinger::assessment
