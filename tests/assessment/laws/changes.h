// What may be done to an attempt without changing what is measured: each of metric.h's laws as a change of a
// recording and its setting, and how far values may move by it.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "assessment/metrics/metric.h"
#include "tests/assessment/laws/random_attempt.h"

namespace seldinger::assessment {

// How far a metric may move and still count as unchanged. Counts and yes or no do not move.
struct Slack {
  double relative = 0.0;
  double share = 0.0;     // of shares
  double absolute = 0.0;  // of all others, in their unit; of areas ten times as much
  double allowed(const MetricInfo& info, double value) const;
};

struct Changed {
  RandomAttempt before, after;
  Slack slack;
};

struct LawInfo {
  Law law;
  const char* name;    // "any speed"
  const char* column;  // of a table
  const char* slack;   // why values may move so far
  // Nothing: the law does not speak of an attempt like this.
  std::optional<Changed> (*change)(const RandomAttempt& attempt, Draw& draw);
};

// All but kNothingIsNothing.
std::span<const LawInfo> laws();

// `attempt` in another frame of reference: skin, structures, target, plan, hands and beam.
RandomAttempt moved_to(const RandomAttempt& attempt, const World& world);

}  // namespace seldinger::assessment
