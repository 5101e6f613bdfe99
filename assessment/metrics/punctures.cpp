#include "assessment/metrics/punctures.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "assessment/signals.h"

namespace seldinger::assessment {
namespace {

constexpr double kPunctureDepthMm = 2.0, kPunctureSeconds = 0.1, kRearmDepthMm = -1.0;  // assessment.md §8
constexpr double kPartialShare = 0.2, kPartialMinMm = 2.0, kPartialMaxMm = 5.0;         // clinical.md, Metrics

struct Counts {
  int punctures = 0, full = 0, partial = 0;
};

// One pass over the poses: a puncture counts when depth stayed > 2 mm for 100 ms, the next only after −1 mm.
Counts count(const Signals& signals) {
  Counts counts;
  bool armed = signals.passages.front().depth_mm <= kPunctureDepthMm;  // what starts inside is no puncture
  bool deep = false, fallen = false;
  double deep_since_s = 0.0, highest_mm = 0.0, lowest_mm = 0.0;
  for (std::size_t i = 0; i < signals.poses.size(); ++i) {
    const cases::SkinPassage& skin = signals.passages[i];
    const double t_s = signals.poses[i].t_s;
    if (i > 0 && signals.gap(i - 1)) deep = false;  // what happened in a gap is not known
    // Sample and hold: the depth of the pose before lasted until now.
    if (armed && deep && t_s - deep_since_s >= kPunctureSeconds - kTimeTolerance_s) {
      ++counts.punctures;
      armed = false;
    }
    if (skin.depth_mm > kPunctureDepthMm) {
      if (!deep) deep_since_s = t_s;
      deep = true;
    } else {
      deep = false;
    }
    if (skin.depth_mm < kRearmDepthMm && !armed) {
      ++counts.full;
      armed = true;
    }
    if (!skin.in_body) {
      fallen = false;
      highest_mm = 0.0;
      continue;
    }
    const double inserted_mm = glm::dot(skin.tip_lps_mm - skin.entry_lps_mm, signals.poses[i].needle_direction);
    highest_mm = std::max(highest_mm, inserted_mm);
    const double hysteresis_mm = std::clamp(kPartialShare * highest_mm, kPartialMinMm, kPartialMaxMm);
    if (!fallen) {
      fallen = highest_mm - inserted_mm >= hysteresis_mm;
      lowest_mm = inserted_mm;
      continue;
    }
    lowest_mm = std::min(lowest_mm, inserted_mm);
    if (inserted_mm - lowest_mm >= hysteresis_mm) {
      ++counts.partial;
      fallen = false;
      highest_mm = inserted_mm;
    }
  }
  return counts;
}

Measured number(const Signals& signals, int Counts::*part) {
  if (signals.setting.skin->empty()) return Measured::none("no_skin");
  if (signals.only_gaps()) return Measured::none("only_gaps");
  return Measured::of(count(signals).*part);
}

}  // namespace

Measured skin_punctures(const Signals& signals) {
  return number(signals, &Counts::punctures);
}

Measured withdrawals_partial(const Signals& signals) {
  return number(signals, &Counts::partial);
}

Measured withdrawals_full(const Signals& signals) {
  return number(signals, &Counts::full);
}

}  // namespace seldinger::assessment
