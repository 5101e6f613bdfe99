#include "assessment/grading/standard.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>

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
                                        "longest_advance_between_exposures",
                                        "time_total"};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return quantile(values, 0.5);
}

// The medians of those who have a value; one a person.
std::vector<double> medians_of(const std::map<std::string, std::vector<const ExpertAttempt*>>& by_person,
                               const MetricInfo& info) {
  std::vector<double> medians;
  for (const auto& [person, attempts] : by_person) {
    std::vector<double> values;
    for (const ExpertAttempt* attempt : attempts) {
      const MetricValue* found = find_version(attempt->metrics, info.id, info.version);
      if (found != nullptr && found->value && std::isfinite(*found->value)) values.push_back(*found->value);
    }
    if (!values.empty()) medians.push_back(median(std::move(values)));
  }
  return medians;
}

MetricBand band_of(const MetricInfo& info, std::vector<double> medians) {
  std::sort(medians.begin(), medians.end());
  MetricBand band;
  band.id = info.id;
  band.version = info.version;
  band.unit = info.unit;
  band.n = medians.size();
  band.low = quantile(medians, kLowest);
  band.high = quantile(medians, kHighest);
  const auto n = static_cast<double>(medians.size());
  // From the first value on, so that equal values have that mean and no spread at all.
  double sum = 0.0, squares = 0.0;
  for (const double value : medians) sum += value - medians.front();
  band.mean = medians.front() + sum / n;
  for (const double value : medians) squares += (value - band.mean) * (value - band.mean);
  band.sd = std::sqrt(squares / (n - 1.0));
  return band;
}

// The same for the same attempts, in any order and any library.
std::string id_of(SetKind kind, const std::vector<std::string>& attempt_ids) {
  std::uint64_t hash = static_cast<std::uint64_t>(kind);
  for (const std::string& id : attempt_ids)
    hash = base::hash_combine(hash, base::hash_bytes(std::as_bytes(std::span(id)), id.size()));
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), "%c-%016llx", kind == SetKind::consultants ? 'C' : 'S',
                static_cast<unsigned long long>(hash));
  return text.data();
}

ScorePart part_of(const MetricBand& band, const MetricInfo& info, const Gradable& attempt) {
  ScorePart part{band.id, band.unit, band.version, std::nullopt, std::nullopt, "", band.mean, band.sd};
  const MetricValue* found = find_version(attempt.metrics, band.id, band.version);
  if (found != nullptr && found->value && std::isfinite(*found->value)) part.value = found->value;
  if (!(band.sd > 0.0)) {
    part.reason = "no_spread";
  } else if (!part.value) {
    part.reason = found == nullptr ? "not_stored" : found->reason.empty() ? "not_finite" : found->reason;
  } else {
    const double sign = info.direction == Direction::lower_is_better ? -1.0 : 1.0;
    part.z = std::clamp(sign * (*part.value - band.mean) / band.sd, -kMostZ, kMostZ);
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

ExpertSet expert_set(SetKind kind, std::vector<ExpertAttempt> attempts) {
  ExpertSet set;
  set.kind = kind;
  std::map<std::string, std::vector<const ExpertAttempt*>> by_person;
  for (const ExpertAttempt& attempt : attempts)
    if (why_not_gradable(attempt.metrics).empty())
      by_person[kind == SetKind::consultants ? attempt.person_id : attempt.attempt_id].push_back(&attempt);
  if (kind == SetKind::consultants)
    std::erase_if(by_person, [](const auto& one) { return one.second.size() < kStandardAttempts; });
  for (const auto& [person, own] : by_person) {
    set.person_ids.push_back(person);
    for (const ExpertAttempt* attempt : own) {
      set.attempt_ids.push_back(attempt->attempt_id);
      set.newest_us = std::max(set.newest_us, attempt->started_us);
    }
  }
  if (by_person.empty()) return set;
  std::sort(set.attempt_ids.begin(), set.attempt_ids.end());
  set.id = id_of(kind, set.attempt_ids);
  if (by_person.size() < kLeastShown) return set;
  for (const MetricInfo& info : registry()) {
    if (info.group == Group::recording) continue;  // says how it was recorded, not what was done
    std::vector<double> medians = medians_of(by_person, info);
    if (medians.size() == by_person.size()) set.bands.push_back(band_of(info, std::move(medians)));
  }
  return set;
}

Score score(const ExpertSet& set, const Grade& grade, const Gradable& attempt, std::string_view person_id) {
  Score made;
  made.set_id = set.id;
  made.reason = grade.reason;
  if (!made.reason.empty()) return made;
  made.reason = "no_expert_set";
  if (set.kind != SetKind::consultants || set.bands.empty()) return made;
  made.reason = "of_the_set";
  if (!person_id.empty() && std::binary_search(set.person_ids.begin(), set.person_ids.end(), person_id))
    return made;
  for (const MetricBand& band : set.bands)
    if (std::find(std::begin(kScored), std::end(kScored), band.id) != std::end(kScored))
      made.parts.push_back(part_of(band, *find_metric(band.id), attempt));
  double sum = 0.0;
  std::size_t n = 0;
  made.reason = "missing_metric";
  for (const ScorePart& part : made.parts) {
    if (part.reason == "no_spread") continue;
    if (!part.z) return made;
    sum += *part.z;
    ++n;
  }
  made.reason = "no_spread";
  if (n == 0) return made;
  made.reason = grade.critical_errors() > 0 ? "critical_error" : "";
  made.value = grade.critical_errors() > 0 ? 0.0 : 50.0 + 50.0 / kMostZ * sum / static_cast<double>(n);
  return made;
}

}  // namespace seldinger::assessment
