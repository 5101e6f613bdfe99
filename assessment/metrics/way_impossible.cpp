// A needle where no needle of a hand can be: an attempt with such a way is not graded.
#include <glm/geometric.hpp>

#include "assessment/metrics/tables.h"
#include "assessment/signals/signals.h"
#include "sim/case/patient_position.h"

namespace seldinger::assessment {
namespace {

constexpr double kThereSeconds = 0.1;   // as a puncture counts; what grazes an edge is shorter
constexpr double kAheadMm = 5.0;        // from the entry on: what comes out nearer is drawn back or slips along
constexpr double kSteepUpwards = 0.5;   // sine of 30°
constexpr double kBelowTableMm = 10.0;  // of the hub: a mattress gives way

// Whether the tip is where only a cut side of the CT led it: in the body, not through skin; or beyond it, inside.
bool past_a_cut(const cases::SkinPassage& skin) {
  return skin.geometric_inside != skin.in_body;
}

bool through_a_cut(const Signals& signals) {
  double since_s = 0.0;
  bool past = false;
  for (std::size_t i = 0; i < signals.poses.size(); ++i) {
    if (i > 0 && signals.gap(i - 1)) past = false;
    if (past && signals.poses[i].t_s - since_s >= kThereSeconds - kTimeTolerance_s) return true;
    const bool is = past_a_cut(signals.passages[i]);
    if (is && !past) since_s = signals.poses[i].t_s;
    past = is;
  }
  // The trigger may fall at once.
  return signals.endpoint && past_a_cut(signals.passages.back());
}

bool out_ahead(const Signals& signals) {
  for (std::size_t i = 1; i < signals.poses.size(); ++i) {
    const cases::SkinPassage &before = signals.passages[i - 1], &now = signals.passages[i];
    if (!before.in_body || now.in_body || signals.gap(i - 1)) continue;
    const glm::dvec3& along = signals.poses[i].needle_direction;
    if (glm::dot(now.tip_lps_mm - before.tip_lps_mm, along) > 0.0 &&
        glm::dot(now.tip_lps_mm - before.entry_lps_mm, along) > kAheadMm)
      return true;
  }
  return false;
}

// The patient lies on the table; a needle that points up at him, its hub below, came through it.
bool through_the_table(const Signals& signals) {
  if (!signals.setting.table_mm) return false;
  const glm::dvec3 up = cases::upwards(signals.setting.position);
  for (std::size_t i = 0; i < signals.poses.size(); ++i) {
    const cases::PoseSample& pose = signals.poses[i];
    const glm::dvec3 hub = pose.tip_lps_mm - pose.needle_direction * signals.setting.instrument.length_mm;
    if (signals.passages[i].in_body && glm::dot(pose.needle_direction, up) > kSteepUpwards &&
        glm::dot(hub, up) < *signals.setting.table_mm - kBelowTableMm)
      return true;
  }
  return false;
}

// What begins in the body has come through no skin that was recorded.
bool begins_inside(const Signals& signals) {
  return !signals.passages.empty() && signals.passages.front().in_body &&
         signals.passages.front().depth_mm > kPunctureDepthMm;
}

Measured way_impossible(const Signals& signals) {
  return Measured::of(
      begins_inside(signals) || through_a_cut(signals) || out_ahead(signals) || through_the_table(signals) ? 1.0
                                                                                                           : 0.0);
}

constexpr MetricInfo kWayMetrics[] = {
    {"way_impossible", 2, "bool", "Impossible path", Group::recording, Direction::lower_is_better, kSkin,
     "1 where the tip was, for 0.1 s or when the trigger was pressed, in a place that it could only have reached "
     "through a cut side of the CT; where it left the body ahead, 5 mm or more from where it came in; or where the "
     "needle in the body pointed up by more than 30° with its hub 10 mm or more below the table: no hand does "
     "that; or where the recording begins with the tip 2 mm or more below the skin, so that it shows no puncture. "
     "Else 0. Such an attempt is not graded.",
     "docs/clinical.md, Body and patient", &way_impossible, kProportion, kInAnyFrame | kMirrored | kOneDarkFrame,
     "1: also 0 where the recording began with the tip below the skin."},
};

}  // namespace

std::span<const MetricInfo> way_metrics() {
  return kWayMetrics;
}

}  // namespace seldinger::assessment
