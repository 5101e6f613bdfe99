#include "assessment/grading/contradictions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "assessment/grading/debrief.h"
#include "assessment/grading/plain_words.h"
#include "assessment/metrics/tables.h"
#include "assessment/registry.h"

namespace seldinger::assessment {
namespace {

constexpr double kNoEnd = std::numeric_limits<double>::infinity();
constexpr double kAnything = std::numeric_limits<double>::min();  // of a length: more than none

// What a value can be at all.
struct Range {
  double low = -kNoEnd, high = kNoEnd;
};

// Where the definition ends it and the scale does not say so.
struct Most {
  std::string_view metric;
  double high;
};
constexpr Most kMost[] = {{"clearance_min", kMostClearanceMm},
                          {"view_angle_max", 90.0},
                          {"plane_angle_max", 90.0},
                          {"plane_angle_mean", 90.0},
                          {"entry_angle_error", 180.0},
                          {"ldlj", 0.0},
                          {"sparc", 0.0}};

Range range_of(const MetricInfo& info, const Guidance& guidance) {
  Range range;
  if (info.estimand.scale != Scale::interval) range.low = 0.0;
  if (info.estimand.scale == Scale::share || info.estimand.scale == Scale::yes_no) range.high = 1.0;
  for (const Most& one : kMost)
    if (one.metric == info.id) range.high = one.high;
  if (std::string_view(info.id) == "core_in_target" && guidance.notch_mm) range.high = *guidance.notch_mm;
  return range;
}

// Who has at least so much of the one has at least, or at most, so much of the other.
struct Follows {
  std::string_view metric;
  double at_least;
  std::string_view other;
  Comparison comparison;
  double value;
  const char* because;
};
constexpr const char* kUnderSkin = "the target lies under the skin";
constexpr const char* kAskedFor = "the breath is held only when it is asked for";
constexpr const char* kFirstPass = "a first pass is one puncture, without withdrawal, that hits";
constexpr Follows kFollows[] = {
    {"hit", 1.0, "skin_punctures", Comparison::at_least, 1.0, kUnderSkin},
    {"core_in_target", kAnything, "skin_punctures", Comparison::at_least, 1.0, kUnderSkin},
    {"must_cross_length", kAnything, "skin_punctures", Comparison::at_least, 1.0,
     "what must be crossed lies under the skin"},
    {"first_pass_success", 1.0, "hit", Comparison::at_least, 1.0, kFirstPass},
    {"first_pass_success", 1.0, "skin_punctures", Comparison::at_most, 1.0, kFirstPass},
    {"first_pass_success", 1.0, "withdrawals_partial", Comparison::at_most, 0.0, kFirstPass},
    {"fired_breath_held", 1.0, "breath_holds_asked", Comparison::at_least, 1.0, kAskedFor},
    {"advance_breath_held_share", kAnything, "breath_holds_asked", Comparison::at_least, 1.0, kAskedFor},
    {"view_angle_max", kAnything, "views", Comparison::at_least, 2.0, "an angle lies between two views"}};

// Of both, measured on the same attempt, the first is never more than the second.
struct Part {
  std::string_view part, whole;
};
constexpr Part kParts[] = {{"vis_joint", "vis_needle"},
                           {"vis_joint_2_mm", "vis_joint_5_mm"},
                           {"blind_advance_max", "blind_advance"},
                           {"nogo_length_critical", "nogo_length"},
                           {"nogo_length_major", "nogo_length"},
                           {"nogo_length_advisory", "nogo_length"},
                           {"path_in_tissue", "path_tip"},
                           {"plane_angle_mean", "plane_angle_max"},
                           {"tip_target_lateral", "tip_target_dist"},
                           {"time_needle", "time_total"},
                           {"time_search", "time_total"},
                           {"time_talk", "time_total"},
                           {"beam_while_moving", "fluoroscopy_time"},
                           {"hand_in_beam", "fluoroscopy_time"},
                           {"views", "pulses"}};
constexpr const char* kOfTheWhole = "a part is never more than the whole";

// Null without a puncture, beside what needs the tip in tissue.
constexpr std::string_view kOfAPuncture[] = {"entry_angle_error", "entry_point_error", "withdrawn_at_end",
                                             "first_pass_success", "time_puncture_to_target"};

bool needs_a_puncture(const MetricInfo& info) {
  return (info.needs & kTissue) != 0 ||
         std::find(std::begin(kOfAPuncture), std::end(kOfAPuncture), info.id) != std::end(kOfAPuncture);
}

// What a criterion demands, itself or by what follows from it.
struct Demand {
  std::string metric;
  bool at_least = false;
  double value = 0.0;
  std::size_t criterion = 0;  // of the rule
  std::string because;        // empty: it says so itself
};

std::vector<Demand> what_follows(const Demand& from, const Guidance& guidance) {
  std::vector<Demand> made;
  const auto add = [&](std::string_view metric, bool at_least, double value, const char* because) {
    made.push_back({std::string(metric), at_least, value, from.criterion, because});
  };
  for (const Follows& one : kFollows)
    if (from.at_least && from.metric == one.metric && from.value >= one.at_least)
      add(one.other, one.comparison == Comparison::at_least, one.value, one.because);
  for (const Part& one : kParts) {
    if (from.at_least && from.metric == one.part) add(one.whole, true, from.value, kOfTheWhole);
    if (!from.at_least && from.metric == one.whole) add(one.part, false, from.value, kOfTheWhole);
  }
  if (from.at_least && from.metric == "decision_right" && from.value >= kAnything && guidance.defer_is_right)
    add("skin_punctures", false, 0.0, "the right decision is to defer, which is not to puncture");
  return made;
}

std::vector<Demand> demands_of(const PassRule& rule, const Guidance& guidance) {
  std::vector<Demand> all;
  for (std::size_t i = 0; i < rule.criteria.size(); ++i) {
    const Criterion& one = rule.criteria[i];
    const MetricInfo* info = find_metric(one.metric);
    if (info == nullptr || version_of(*info, guidance.sight_law) != one.version || !std::isfinite(one.value))
      continue;
    if (one.comparison != Comparison::at_most) all.push_back({one.metric, true, one.value, i, ""});
    if (one.comparison != Comparison::at_least) all.push_back({one.metric, false, one.value, i, ""});
    if (needs_a_puncture(*info))
      all.push_back({"skin_punctures", true, 1.0, i, "one of them has no value until the needle is in the body"});
  }
  for (std::size_t i = 0; i < all.size(); ++i)  // what follows from what follows, too: no chain leads back
    for (Demand& one : what_follows(Demand(all[i]), guidance)) all.push_back(std::move(one));
  return all;
}

// "“Skin punctures: none” (skin_punctures <= 0)".
std::string named(const Criterion& criterion) {
  const MetricInfo& info = *find_metric(criterion.metric);
  return "“" + std::string(info.label) + ": " + limit_text(criterion, info.unit) + "” (" + text_of(criterion) + ")";
}

// Why no value of the metric meets the criterion; empty where one does.
std::string why_never(const Criterion& criterion, const MetricInfo& info, const Guidance& guidance) {
  const Range range = range_of(info, guidance);
  const double value = criterion.value;
  const bool share = info.estimand.scale == Scale::share;
  if (share && (value < range.low || value > range.high)) return "a share lies between 0 and 1: 80 % is 0.8";
  if (info.estimand.scale == Scale::yes_no && (value < 0.0 || value > 1.0)) return "it is 1 (yes) or 0 (no)";
  const bool whole = info.estimand.scale == Scale::count || info.estimand.scale == Scale::yes_no;
  if (criterion.comparison == Comparison::equal && whole && value != std::floor(value))
    return "what is counted is a whole number";
  if (criterion.comparison != Comparison::at_most && value > range.high)
    return "it is never more than " + plain_value(range.high, info.unit);
  if (criterion.comparison != Comparison::at_least && value < range.low)
    return "it is never less than " + plain_value(range.low, info.unit);
  return "";
}

}  // namespace

std::vector<base::Problem> contradictions_of(const PassRule& rule, const Guidance& guidance) {
  std::vector<base::Problem> problems;
  std::set<std::size_t> never;
  const std::vector<Demand> demands = demands_of(rule, guidance);
  for (const Demand& one : demands) {
    const Criterion& criterion = rule.criteria[one.criterion];
    if (never.contains(one.criterion)) continue;
    const std::string why = why_never(criterion, *find_metric(criterion.metric), guidance);
    if (why.empty()) continue;
    never.insert(one.criterion);
    problems.push_back({"never_met", named(criterion) + " can never be met: " + why});
  }
  std::set<std::pair<std::size_t, std::size_t>> told;
  for (const Demand& low : demands)
    for (const Demand& high : demands) {
      if (!low.at_least || high.at_least || low.metric != high.metric || !(low.value > high.value)) continue;
      if (never.contains(low.criterion) || never.contains(high.criterion)) continue;
      const auto pair = std::minmax(low.criterion, high.criterion);
      if (!told.insert({pair.first, pair.second}).second) continue;
      const std::string& why = low.because.empty() ? high.because : low.because;
      problems.push_back({"contradictory", named(rule.criteria[pair.first]) + " and " +
                                               named(rule.criteria[pair.second]) + " cannot both be met" +
                                               (why.empty() ? "" : ": " + why)});
    }
  return problems;
}

}  // namespace seldinger::assessment
