#include "assessment/fault_moments.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "assessment/metrics/tables.h"
#include "assessment/procedure/evidence.h"
#include "assessment/registry.h"

namespace seldinger::assessment {
namespace {

using cases::StructureRule;
using Times = std::vector<double>;

Times at(const std::optional<double>& t_s) {
  return t_s ? Times{*t_s} : Times{};
}

template <Evidence evidence>
Times of_evidence(const Signals& signals) {
  return at(first_s(evidence, signals, unmet_needs(signals)));
}

Times fired(const Signals& signals) {
  return signals.endpoint ? Times{signals.endpoint->t_s} : Times{};
}
Times punctures(const Signals& signals) {
  return count_punctures(signals).punctures_s;
}
Times first_puncture(const Signals& signals) {
  return at(count_punctures(signals).first_s);
}
Times drawn_back(const Signals& signals) {
  return count_punctures(signals).partial_withdrawals_s;
}
Times drawn_out(const Signals& signals) {
  return count_punctures(signals).full_withdrawals_s;
}
Times longest_unseen(const Signals& signals) {
  const auto run = longest_blind_run(signals);
  return run ? Times{run->from_s} : Times{};
}
Times beyond_plane(const Signals& signals) {
  return at(first_beyond_plane_s(signals, 0.0));
}
Times pain(const Signals& signals) {
  Times times = of_evidence<Evidence::skin_pain>(signals);
  const Times bone = of_evidence<Evidence::bone_pain>(signals);
  times.insert(times.end(), bone.begin(), bone.end());
  std::sort(times.begin(), times.end());
  return times;
}

struct Row {
  std::string_view metric;
  Needs needs;  // Need, or-ed
  Times (*times)(const Signals&);
  const char* words;
};
constexpr const char *kFired = "the trigger was pressed", *kIn = "the needle went through the skin",
                     *kInside = "the tip came into a structure to stay out of",
                     *kUnseen = "the longest advance with the tip out of the picture began";
constexpr Needs kPuncture = kSkin | kMotion, kSeenPlane = kPicturePlane | kSkin | kPictures | kMotion;
constexpr Row kRows[] = {
    {"hit", kEndpoint, &fired, kFired},
    {"first_pass_success", kEndpoint, &fired, kFired},
    {"core_in_target", kEndpoint, &fired, kFired},
    {"tip_target_dist", kEndpoint, &fired, kFired},
    {"tip_target_surface", kEndpoint, &fired, kFired},
    {"tip_target_axial", kEndpoint, &fired, kFired},
    {"tip_target_lateral", kEndpoint, &fired, kFired},
    {"back_wall_dist", kEndpoint, &fired, kFired},
    {"must_cross_length", kEndpoint, &fired, kFired},
    {"fired_breath_held", kEndpoint, &fired, kFired},
    {"entry_angle_error", kPuncture, &first_puncture, kIn},
    {"entry_point_error", kPuncture, &first_puncture, kIn},
    {"skin_punctures", kPuncture, &punctures, "the skin was punctured"},
    {"withdrawals_partial", kPuncture, &drawn_back, "the needle was drawn back"},
    {"withdrawals_full", kPuncture, &drawn_out, "the needle was drawn out of the skin"},
    {"nogo_contacts", kNoGo, &nogo_entries_s, kInside},
    {"nogo_length", kNoGo, &nogo_entries_s, kInside},
    {"nogo_time", kNoGo, &nogo_entries_s, kInside},
    {"clearance_min", kNoGo, &nogo_entries_s, kInside},
    {"nogo_length_critical", kNoGoCritical, &entries_s<StructureRule::critical>,
     "the tip came into a critical structure"},
    {"nogo_length_major", kNoGoMajor, &entries_s<StructureRule::major>, "the tip came into a major structure"},
    {"nogo_length_advisory", kNoGoAdvisory, &entries_s<StructureRule::advisory>,
     "the tip came into a structure that is better avoided"},
    {"capsule_punctures", kOrgan, &entries_s<StructureRule::organ>, "the organ’s capsule was punctured"},
    {"posterior_wall", kLumen, &far_walls_s, "the tip went through the far wall"},
    {"blind_advance", kSeenPlane | kInPlane, &longest_unseen, kUnseen},
    {"blind_advance_max", kSeenPlane | kInPlane, &longest_unseen, kUnseen},
    {"advance_visible_share", kSeenPlane | kInPlane, &longest_unseen, kUnseen},
    {"advance_joint_visible_last_20_mm", kSeenPlane | kInPlane, &longest_unseen, kUnseen},
    {"advance_beyond_plane", kSeenPlane | kOutOfPlane, &beyond_plane, "the tip went beyond the picture’s plane"},
    {"pain_reactions", kPatient | kSkin | kEvents, &pain, "the patient felt pain"},
    {"advance_in_breath", kBreathes | kTarget | kSkin | kEvents, &of_evidence<Evidence::pushed_in_breath>,
     "the needle was pushed on while the breath moved"},
    {"advance_breath_held_share", kBreathes | kTarget | kSkin | kEvents, &of_evidence<Evidence::pushed_in_breath>,
     "the needle was pushed on while the breath moved"},
    {"hand_in_beam", kXray | kPictures | kBeam, &of_evidence<Evidence::hand_in_beam>, "a pulse met the hand"}};

}  // namespace

std::vector<FaultMoment> fault_moments(const Signals& signals) {
  const Needs unmet = unmet_needs(signals);
  std::vector<FaultMoment> faults;
  for (const Row& row : kRows) {
    if ((row.needs & unmet) != 0) continue;
    for (const double t_s : row.times(signals)) faults.push_back({std::string(row.metric), t_s, row.words});
  }
  return faults;
}

const FaultMoment* find_fault(const std::vector<FaultMoment>& faults, const std::string& metric, double at_most) {
  const MetricInfo* info = find_metric(metric);
  const bool counts = info != nullptr && info->estimand.scale == Scale::count;
  auto skip = counts ? static_cast<std::ptrdiff_t>(std::max(0.0, std::floor(at_most))) : 0;
  for (const FaultMoment& one : faults)
    if (one.metric == metric && skip-- == 0) return &one;
  return nullptr;
}

}  // namespace seldinger::assessment
