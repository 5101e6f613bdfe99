#include "assessment/moments.h"

#include <algorithm>
#include <cmath>

#include "assessment/metrics/tables.h"

namespace seldinger::assessment {
namespace {

std::vector<Moment> candidates(const Signals& signals) {
  std::vector<Moment> all;
  const auto add = [&](MomentKind kind, double t_s) { all.push_back({t_s, kind}); };
  const double last_s = signals.poses.back().t_s;
  add(signals.endpoint ? MomentKind::fire : MomentKind::end, signals.endpoint ? signals.endpoint->t_s : last_s);
  const PunctureCounts counts = count_punctures(signals);
  for (const double t_s : counts.punctures_s) add(MomentKind::puncture, t_s);
  if (const auto run = longest_blind_run(signals)) add(MomentKind::blind_run, run->to_s);
  for (const double t_s : counts.partial_withdrawals_s) add(MomentKind::withdrawal, t_s);
  for (const double t_s : counts.full_withdrawals_s) add(MomentKind::full_withdrawal, t_s);
  for (const cases::FrameTruth& frame : signals.frames)
    if (frame.live && frame.target) {
      add(MomentKind::target_seen, frame.t_s);
      break;
    }
  std::stable_sort(all.begin(), all.end(), [](const Moment& a, const Moment& b) { return a.kind < b.kind; });
  return all;
}

bool by_time(const Moment& a, const Moment& b) {
  return a.t_s < b.t_s;
}

}  // namespace

const char* words_for(MomentKind kind, cases::Modality modality) noexcept {
  switch (kind) {
    case MomentKind::fire:
      return "Fired";
    case MomentKind::puncture:
      return "Through the skin";
    case MomentKind::blind_run:
      return modality == cases::Modality::xray ? "End of the longest advance between exposures"
                                               : "End of the longest unseen advance";
    case MomentKind::withdrawal:
      return "Before drawing back";
    case MomentKind::full_withdrawal:
      return "Before drawing out of the skin";
    case MomentKind::target_seen:
      return "Target first seen";
    case MomentKind::end:
      return "End of the recording";
    case MomentKind::between:
      break;
  }
  return "On the way";
}

std::vector<Moment> telling_moments(const Signals& signals) {
  std::vector<Moment> chosen;
  const auto apart = [&](double t_s) {
    return std::all_of(chosen.begin(), chosen.end(),
                       [&](const Moment& other) { return std::abs(other.t_s - t_s) >= kMomentsApart_s; });
  };
  for (const Moment& moment : candidates(signals))
    if (chosen.size() < kMostMoments && apart(moment.t_s)) chosen.push_back(moment);
  std::sort(chosen.begin(), chosen.end(), by_time);
  // The widest gap gets a picture, the way before the first moment being one.
  while (chosen.size() < kLeastMoments) {
    double from_s = signals.poses.front().t_s, widest_s = 0.0, middle_s = 0.0;
    for (const Moment& moment : chosen) {
      if (moment.t_s - from_s > widest_s) {
        widest_s = moment.t_s - from_s;
        middle_s = 0.5 * (moment.t_s + from_s);
      }
      from_s = moment.t_s;
    }
    if (widest_s < 2.0 * kMomentsApart_s) break;
    chosen.push_back({middle_s, MomentKind::between});
    std::sort(chosen.begin(), chosen.end(), by_time);
  }
  return chosen;
}

}  // namespace seldinger::assessment
