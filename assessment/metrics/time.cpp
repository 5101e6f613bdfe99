// Metrics of time.
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "assessment/metrics/tables.h"
#include "assessment/signals/signals.h"

namespace seldinger::assessment {
namespace {

Measured time_total(const Signals& signals) {
  return Measured::of(signals.poses.back().t_s - signals.poses.front().t_s);
}

Measured time_in_tissue(const Signals& signals) {
  double time_s = 0.0;
  for (std::size_t i = 0; i + 1 < signals.poses.size(); ++i)
    if (signals.passages[i].in_body && !signals.gap(i)) time_s += signals.interval_s(i);
  return Measured::of(time_s);
}

Measured time_puncture_to_target(const Signals& signals) {
  const PunctureCounts counts = count_punctures(signals);
  if (!counts.first_s) return Measured::none("never_punctured");
  return Measured::of(signals.endpoint->t_s - *counts.first_s);
}

// So far a hand that lays hold of a tool, and breath, do not move it.
constexpr double kStirredMm = 5.0, kStirredDeg = 5.0;

bool turned(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) > kStirredDeg * std::numbers::pi / 180.0;
}
bool stirred(const cases::PoseSample& first, const cases::PoseSample& now) {
  return glm::distance(first.tip_lps_mm, now.tip_lps_mm) > kStirredMm ||
         glm::distance(first.probe_origin_lps_mm, now.probe_origin_lps_mm) > kStirredMm ||
         turned(first.needle_direction, now.needle_direction) || turned(first.probe_axial, now.probe_axial) ||
         turned(first.probe_lateral, now.probe_lateral);
}

// When something was first done with the hands: needle or probe moved, or a pulse fired. Nothing: never.
std::optional<double> begun_s(const Signals& signals) {
  std::optional<double> begun;
  for (std::size_t i = 0; i < signals.poses.size() && !begun; ++i)
    if (signals.passages[i].in_body || stirred(signals.poses.front(), signals.poses[i]))
      begun = signals.poses[i].t_s;
  for (const cases::FrameTruth& frame : signals.frames)
    if (frame.beam && (!begun || frame.t_s < *begun)) begun = frame.t_s;
  return begun;
}

// time_total in three; an interval belongs as a whole to what it began with, a gap to what was before it.
struct Parts {
  double talk_s = 0.0, search_s = 0.0, needle_s = 0.0;
};
Parts parts_of(const Signals& signals) {
  const auto begun = begun_s(signals);
  Parts parts;
  for (std::size_t i = 0; i + 1 < signals.poses.size(); ++i) {
    const bool talking = !begun || signals.poses[i].t_s < *begun;
    (signals.passages[i].in_body ? parts.needle_s
     : talking                   ? parts.talk_s
                                 : parts.search_s) += signals.interval_s(i);
  }
  return parts;
}

Measured time_talk(const Signals& signals) {
  return Measured::of(parts_of(signals).talk_s);
}
Measured time_search(const Signals& signals) {
  return Measured::of(parts_of(signals).search_s);
}
Measured time_needle(const Signals& signals) {
  return Measured::of(parts_of(signals).needle_s);
}

constexpr const char* kThreeParts =
    "judgement: long talk does not mean slow hands, and the patient bears only the needle";

constexpr MetricInfo kTimeMetrics[] = {
    {"time_total", 1, "s", "Time", Group::time, Direction::lower_is_better, 0,
     "From the first pose to the endpoint; without an endpoint to the last pose.", kJohnson, &time_total,
     kMedianTimeCensored, kAnyPlace | kInAnyBreath | kOneDarkFrame | kLostSamples},
    {"time_talk", 1, "s", "Time before the hands", Group::time, Direction::none, kSkin,
     "The part of time_total before the hands did anything, for looking, thinking and talking: until needle or "
     "probe was more than 5 mm from where it was at the first pose, or turned by more than 5°, or a pulse was "
     "fired, or the tip was below the skin. time_talk, time_search and time_needle add up to time_total.",
     kThreeParts, &time_talk, kMedianRatio, kAnyPlace | kOneDarkFrame | kLostSamples},
    {"time_search", 1, "s", "Time at work outside", Group::time, Direction::lower_is_better, kSkin,
     "The part of time_total after time_talk in which the tip was not below the skin: the probe is in use or the "
     "entry is sought, also between two punctures. A gap counts with what came before it.",
     kThreeParts, &time_search, kMedianRatio, kAnyPlace | kIdleBefore | kOneDarkFrame | kLostSamples},
    {"time_needle", 1, "s", "Time with needle in", Group::time, Direction::lower_is_better, kSkin,
     "The part of time_total in which the tip was below the skin. A gap counts with what came before it; "
     "time_in_tissue leaves gaps out.",
     kThreeParts, &time_needle, kMedianTimeCensored,
     kAnyPlace | kInAnyBreath | kIdleBefore | kOneDarkFrame | kLostSamples},
    {"time_in_tissue", 1, "s", "Time in tissue", Group::time, Direction::lower_is_better, kSkin | kMotion,
     "Time with the tip below the skin; gaps over 0.25 s are left out.", "Perk Tutor's TissueTime", &time_in_tissue,
     kMedianRatio, kAnyPlace | kInAnyBreath | kIdleBefore | kOneDarkFrame | kLostSamples},
    {"time_puncture_to_target", 1, "s", "From puncture to trigger", Group::time, Direction::lower_is_better,
     kEndpoint | kSkin | kMotion,
     "From the first skin puncture that counts, 2 mm deep, to the endpoint. Null: never_punctured.", kJohnson,
     &time_puncture_to_target, kMedianTimeCensored,
     kAnyPlace | kInAnyBreath | kIdleBefore | kIdleAfter | kOneDarkFrame | kLostSamples | kNothingIsNothing},
};

}  // namespace

std::span<const MetricInfo> time_metrics() {
  return kTimeMetrics;
}

}  // namespace seldinger::assessment
