#include "assessment/grading/standard.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <tuple>

#include "assessment/estimand.h"
#include "assessment/grading/expert_set_at.h"
#include "assessment/grading/tolerance.h"
#include "assessment/grading/worthwhile.h"
#include "assessment/metrics/quality.h"
#include "assessment/registry.h"
#include "sim/base/check.h"
#include "sim/base/hash.h"

namespace seldinger::assessment {
namespace {

constexpr double kLowest = 0.1, kHighest = 0.9;  // of the band
constexpr double kMostZ = 3.0;                   // so that one metric cannot outweigh all others

constexpr std::string_view kScored[] = {"core_in_target",
                                        "tip_target_dist",
                                        "clearance_min",
                                        "advance_visible_share",
                                        "advance_beyond_plane",
                                        "blind_advance",
                                        "probe_drift_advancing",
                                        "path_inefficiency",
                                        "withdrawals_partial",
                                        "fluoroscopy_time",
                                        "longest_advance_between_exposures"};

// As the metric's estimand has it, of those who have a value that is not among the failures; one a person.
std::vector<double> values_of(const std::map<std::string, std::vector<const ExpertAttempt*>>& by_person,
                              const MetricInfo& info) {
  std::vector<double> values;
  for (const auto& [person, attempts] : by_person) {
    std::vector<Contribution> contributions;
    for (const ExpertAttempt* attempt : attempts) contributions.push_back(contribution_of(info, attempt->metrics));
    if (const OnePerson one = of_one_person(info, contributions); one.estimate) values.push_back(*one.estimate);
  }
  return values;
}

// A share is no more than 1; of what cannot be negative nothing is.
Interval within(const MetricInfo& info, Interval interval, double least) {
  const Scale scale = info.estimand.scale;
  const bool share = scale == Scale::share || std::string_view(info.unit) == "share";
  const bool positive = share || scale == Scale::count || scale == Scale::ratio;
  if (positive && least >= 0.0) interval.low = std::max(interval.low, 0.0);
  if (share) interval.high = std::min(interval.high, 1.0);
  return interval;
}

MetricBand band_of(const MetricInfo& info, std::vector<double> values) {
  std::sort(values.begin(), values.end());
  MetricBand band;
  band.id = info.id;
  band.version = info.version;
  band.unit = info.unit;
  band.n = values.size();
  band.low = quantile(values, kLowest);
  band.high = quantile(values, kHighest);
  const auto n = static_cast<double>(values.size());
  // From the first value on, so that equal values have that mean and no spread at all.
  double sum = 0.0, squares = 0.0;
  for (const double value : values) sum += value - values.front();
  band.mean = values.front() + sum / n;
  for (const double value : values) squares += (value - band.mean) * (value - band.mean);
  band.sd = std::sqrt(squares / (n - 1.0));
  if (band.unit != "bool") {
    const double far = tolerance_factor(band.n, kToleranceShare, kToleranceConfidence) * band.sd;
    band.tolerance = within(info, {band.mean - far, band.mean + far}, values.front());
  }
  return band;
}

// The same for the same values of the same attempts, in any order and any library.
std::string id_of(const ExpertSet& set) {
  std::uint64_t hash = 0;
  const auto add = [&](std::string_view text) {
    hash = base::hash_combine(hash, base::hash_bytes(std::as_bytes(std::span(text)), text.size()));
  };
  for (const std::string& id : set.attempt_ids) add(id);
  for (const MetricBand& band : set.bands) add(band.id + "@" + std::to_string(band.version));
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), "C-%016llx", static_cast<unsigned long long>(hash));
  return text.data();
}

// The last ones of whoever has made enough to be used to it; empty: too few.
std::vector<const ExpertAttempt*> counted_of(std::vector<const ExpertAttempt*> own) {
  if (own.size() < kFamiliarAttempts) return {};
  std::sort(own.begin(), own.end(), [](const ExpertAttempt* a, const ExpertAttempt* b) {
    return std::tie(a->started_us, a->attempt_id) < std::tie(b->started_us, b->attempt_id);
  });
  own.erase(own.begin(), own.end() - static_cast<std::ptrdiff_t>(kCountedAttempts));
  return own;
}

ScorePart part_of(const MetricBand& band, const MetricInfo& info, const Gradable& attempt) {
  ScorePart part{band.id,      band.unit,    band.version,
                 std::nullopt, std::nullopt, "",
                 band.mean,    band.sd,      worthwhile(info).difference};
  const MetricValue* found = find_version(attempt.metrics, band.id, band.version);
  if (found == nullptr) {
    const bool other = std::any_of(attempt.metrics.begin(), attempt.metrics.end(),
                                   [&](const MetricValue& one) { return one.id == band.id; });
    part.reason = other ? "other_version" : "not_stored";
  } else if (!found->value) {
    part.reason = found->reason.empty() ? "no_reason_stored" : found->reason;
  } else if (!std::isfinite(*found->value)) {
    part.reason = "not_finite";
  } else {
    part.value = found->value;
    const double sign = info.direction == Direction::lower_is_better ? -1.0 : 1.0;
    part.z = std::clamp(sign * (*part.value - band.mean) / std::max(band.sd, part.least_sd), -kMostZ, kMostZ);
  }
  return part;
}

}  // namespace

double quantile(std::span<const double> sorted, double p) {
  CHECK(!sorted.empty() && p >= 0.0 && p <= 1.0);
  const double at = static_cast<double>(sorted.size() - 1) * p;
  const auto below = static_cast<std::size_t>(at);
  if (below + 1 >= sorted.size()) return sorted.back();
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[below + 1] - sorted[below]);
}

std::span<const std::string_view> scored_metrics() {
  return kScored;
}

const MetricBand* ExpertSet::find(std::string_view metric, int version) const noexcept {
  const auto found = std::find_if(bands.begin(), bands.end(), [&](const MetricBand& one) {
    return one.id == metric && one.version == version;
  });
  return found == bands.end() ? nullptr : &*found;
}

bool ExpertSet::only_other_version(std::string_view metric, int version) const noexcept {
  return find(metric, version) == nullptr &&
         std::any_of(bands.begin(), bands.end(), [&](const MetricBand& one) { return one.id == metric; });
}

ExpertSet expert_set(std::vector<ExpertAttempt> attempts) {
  return expert_set_at(cases::kNewestSightLaw, std::move(attempts));
}

ExpertSet expert_set_at(cases::SightLaw law, std::vector<ExpertAttempt> attempts) {
  ExpertSet set;
  std::map<std::string, std::vector<const ExpertAttempt*>> by_person;
  for (const ExpertAttempt& attempt : attempts)
    if (attempt.completed && why_not_gradable(attempt.metrics).empty())
      by_person[attempt.person_id].push_back(&attempt);
  for (auto& [person, own] : by_person) own = counted_of(std::move(own));
  std::erase_if(by_person, [](const auto& one) { return one.second.empty(); });
  for (const auto& [person, own] : by_person) {
    set.person_ids.push_back(person);
    for (const ExpertAttempt* attempt : own) {
      set.attempt_ids.push_back(attempt->attempt_id);
      set.newest_us = std::max(set.newest_us, attempt->started_us);
    }
  }
  set.people = set.person_ids.size();
  set.attempts = set.attempt_ids.size();
  if (by_person.empty()) return set;
  std::sort(set.attempt_ids.begin(), set.attempt_ids.end());
  if (set.enough_people())
    for (MetricInfo info : registry()) {
      if (info.group == Group::recording) continue;  // says how it was recorded, not what was done
      info.version = version_of(info, law);
      std::vector<double> values = values_of(by_person, info);
      if (values.size() >= kStandardConsultants) set.bands.push_back(band_of(info, std::move(values)));
    }
  set.id = id_of(set);
  return set;
}

Score score(const ExpertSet& set, const Grade& grade, const Gradable& attempt, std::string_view person_id) {
  Score made;
  made.set_id = set.standard() ? set.id : "";
  made.reason = grade.reason;
  if (!made.reason.empty()) return made;
  made.reason = "no_expert_set";
  if (!set.standard()) return made;
  made.reason = "of_the_set";
  if (!person_id.empty() && std::binary_search(set.person_ids.begin(), set.person_ids.end(), person_id))
    return made;
  for (const MetricBand& band : set.bands)
    if (const MetricInfo* info = find_metric(band.id);
        info != nullptr && std::find(std::begin(kScored), std::end(kScored), band.id) != std::end(kScored))
      made.parts.push_back(part_of(band, *info, attempt));
  double sum = 0.0;
  made.reason = "missing_metric";
  if (made.parts.empty()) return made;
  for (const ScorePart& part : made.parts) {
    if (part.reason == "other_version") made.reason = part.reason;
    if (!part.z) return made;
    sum += *part.z;
  }
  made.reason = grade.critical_errors() > 0 ? "critical_error" : "";
  made.value =
      grade.critical_errors() > 0 ? 0.0 : 50.0 + 50.0 / kMostZ * sum / static_cast<double>(made.parts.size());
  return made;
}

}  // namespace seldinger::assessment
