// Skin punctures and withdrawals.
#include <algorithm>

#include "assessment/metrics/tables.h"
#include "assessment/signals/signals.h"

namespace seldinger::assessment {
namespace {

constexpr double kPunctureSeconds = 0.1, kRearmDepthMm = -1.0;                   // our judgement
constexpr double kPartialShare = 0.2, kPartialMinMm = 2.0, kPartialMaxMm = 5.0;  // docs/clinical.md, Metrics

Measured skin_punctures(const Signals& signals) {
  return Measured::of(count_punctures(signals).punctures);
}

Measured withdrawals_partial(const Signals& signals) {
  return Measured::of(count_punctures(signals).partial_withdrawals);
}

Measured withdrawals_full(const Signals& signals) {
  return Measured::of(count_punctures(signals).full_withdrawals);
}

Measured withdrawn_at_end(const Signals& signals) {
  const PunctureCounts counts = count_punctures(signals);
  if (counts.punctures == 0) return Measured::none("never_punctured");
  return Measured::of(counts.withdrawn_at_end ? 1.0 : 0.0);
}

constexpr std::uint32_t kAnyOfThese = kInAnyFrame | kMirrored | kIdleBefore | kIdleAfter | kOneDarkFrame;

constexpr MetricInfo kPuncturesMetrics[] = {
    {"skin_punctures", 1, "count", "Skin punctures", Group::safety, Direction::lower_is_better, kSkin | kMotion,
     "Times the tip went more than 2 mm below the skin for at least 100 ms; the next one counts once the tip has "
     "been 1 mm outside. The edges of the volume are not skin; lung and gas are body. Starting inside is not a "
     "puncture.",
     kJohnson, &skin_punctures, kMeanCount, kAnyOfThese | kInAnyBreath | kLostSamples},
    {"withdrawals_partial", 3, "count", "Partial withdrawals", Group::path, Direction::lower_is_better,
     kSkin | kMotion,
     "Times the hand drew the needle back by 20 % of the depth to which it had pushed it (at least 2, at most 5 "
     "mm) and pushed it on by as much again without coming out of the skin by 1 mm. Movement along the needle "
     "counts only where the tip moved both in the room and in the tissue: breath that slides past a hand at rest "
     "draws nothing back.",
     kVidal, &withdrawals_partial, kMeanCount, kAnyOfThese | kAtAnySpeed | kLostSamples,
     "1: judged by the tip's place in the tissue alone, so that breath past a resting hand drew back with each "
     "cycle; 2: not where the tip came out of the skin by less than 1 mm."},
    {"withdrawals_full", 2, "count", "Full withdrawals", Group::path, Direction::lower_is_better, kSkin | kMotion,
     "Times the needle, once more than 2 mm below the skin for 100 ms, left it by more than 1 mm and punctured it "
     "again; the final removal does not count.",
     kVidal, &withdrawals_full, kMeanCount, kAnyOfThese | kInAnyBreath | kLostSamples,
     "1: the removal at the end of an attempt without a trigger counted, too."},
    {"withdrawn_at_end", 2, "bool", "Withdrawn at the end", Group::path, Direction::none, kSkin | kMotion,
     "1 where the needle, having punctured the skin, was left drawn back at the end, by as much as "
     "withdrawals_partial requires or out of the skin, and was not pushed on again; else 0. Null: never_punctured.",
     "a withdrawal that nothing follows, which no count of withdrawals includes", &withdrawn_at_end, kProportion,
     kAnyOfThese | kAtAnySpeed | kLostSamples | kNothingIsNothing,
     "1: 0 where the tip stood outside of the skin by less than 1 mm."},
};

}  // namespace

// One pass over the poses: a puncture counts when depth stayed > 2 mm for 100 ms, the next only after −1 mm.
PunctureCounts count_punctures(const Signals& signals) {
  PunctureCounts counts;
  bool armed = signals.passages.front().depth_mm <= kPunctureDepthMm;  // what starts inside is no puncture
  bool deep = false, fallen = false;
  double deep_since_s = 0.0, highest_mm = 0.0, lowest_mm = 0.0;
  double highest_s = signals.poses.front().t_s;  // when highest_mm was reached, before any fall from it
  std::size_t entered = 0;                       // the pose with which the tip last came into the body
  bool drawn_out = false;
  double out_s = 0.0;  // when what was drawn out had been deepest
  for (std::size_t i = 0; i < signals.poses.size(); ++i) {
    const cases::SkinPassage& skin = signals.passages[i];
    const double t_s = signals.poses[i].t_s;
    if (i > 0 && signals.gap(i - 1)) deep = false;  // what happened in a gap is not known
    // Sample and hold: the depth of the pose before lasted until now.
    if (armed && deep && t_s - deep_since_s >= kPunctureSeconds - kTimeTolerance_s) {
      if (drawn_out) {  // what was drawn out went in again
        ++counts.full_withdrawals;
        counts.full_withdrawals_s.push_back(out_s);
        drawn_out = false;
      }
      if (++counts.punctures == 1) {
        counts.first_s = deep_since_s;
        counts.first_pose = entered;
      }
      armed = false;
      counts.punctures_s.push_back(deep_since_s);
    }
    if (skin.in_body && (i == 0 || !signals.passages[i - 1].in_body)) entered = i;
    if (skin.depth_mm > kPunctureDepthMm) {
      if (!deep) deep_since_s = t_s;
      deep = true;
    } else {
      deep = false;
    }
    if (skin.depth_mm < kRearmDepthMm && !armed) {
      drawn_out = true;
      out_s = highest_s;
      armed = true;
    }
    if (!skin.in_body && armed) {  // nearer to the skin the puncture goes on
      fallen = false;
      highest_mm = 0.0;
      continue;
    }
    const double inserted_mm = signals.pushed_mm[i];
    if (!fallen && inserted_mm >= highest_mm) highest_s = t_s;
    highest_mm = std::max(highest_mm, inserted_mm);
    const double hysteresis_mm = std::clamp(kPartialShare * highest_mm, kPartialMinMm, kPartialMaxMm);
    if (!fallen) {
      fallen = highest_mm - inserted_mm >= hysteresis_mm;
      lowest_mm = inserted_mm;
      continue;
    }
    lowest_mm = std::min(lowest_mm, inserted_mm);
    if (inserted_mm - lowest_mm >= hysteresis_mm) {
      ++counts.partial_withdrawals;
      counts.partial_withdrawals_s.push_back(highest_s);
      fallen = false;
      highest_mm = inserted_mm;
      highest_s = t_s;
    }
  }
  counts.withdrawn_at_end = counts.punctures > 0 && (fallen || drawn_out);
  return counts;
}

std::span<const MetricInfo> puncture_metrics() {
  return kPuncturesMetrics;
}

}  // namespace seldinger::assessment
