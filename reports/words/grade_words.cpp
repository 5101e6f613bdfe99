#include "reports/words/grade_words.h"

#include <algorithm>
#include <set>
#include <utility>

#include "assessment/grading/debrief.h"
#include "assessment/grading/plain_words.h"
#include "assessment/registry.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

using assessment::Verdict;

std::string counted(std::size_t n, const char* one, const char* many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

// The lower and the upper bound of the same value, or not.
bool bounds_both(const assessment::Criterion& low, const assessment::Criterion& high) {
  return low.metric == high.metric && low.version == high.version && low.critical == high.critical &&
         low.comparison == assessment::Comparison::at_least && high.comparison == assessment::Comparison::at_most &&
         low.value < high.value;
}

std::string both_text(double low, double high, std::string_view unit) {
  if (low == -high) return "within ±" + assessment::plain_value(high, unit);
  return "from " + assessment::plain_value(low, unit) + " to " + assessment::plain_value(high, unit);
}

}  // namespace

std::vector<RuleLine> rule_lines(const assessment::PassRule& rule) {
  std::vector<RuleLine> lines;
  std::set<const assessment::Criterion*> told;
  for (const assessment::Criterion& one : rule.criteria) {
    if (told.contains(&one)) continue;
    const assessment::MetricInfo* info = assessment::find_metric(one.metric);
    const std::string_view unit = info == nullptr ? "" : info->unit;
    std::string bound = assessment::limit_text(one, unit);
    for (const assessment::Criterion& other : rule.criteria) {
      if (!bounds_both(one, other) && !bounds_both(other, one)) continue;
      bound = both_text(std::min(one.value, other.value), std::max(one.value, other.value), unit);
      told.insert(&other);
    }
    lines.push_back({metric_label(one.metric), std::move(bound), one.critical});
  }
  return lines;
}

std::string verdict_word(Verdict verdict) {
  switch (verdict) {
    case Verdict::passed:
      return "Passed";
    case Verdict::failed:
      return "Not passed";
    case Verdict::not_gradable:
      return "Not graded";
    case Verdict::no_rule:
      return "No pass rule";
  }
  return "";
}

std::string verdict_text(const assessment::Grade& grade) {
  std::string text = verdict_word(grade.verdict);
  const std::size_t all = grade.criteria.size(), open = all - grade.met(), errors = grade.critical_errors();
  if (grade.verdict == Verdict::passed) text += ": all " + counted(all, "criterion", "criteria") + " met";
  if (grade.verdict == Verdict::failed) {
    text += ": " + std::to_string(open) + " of " + counted(all, "criterion", "criteria") + " not met";
    if (errors > 0) text += ", " + counted(errors, "critical error", "critical errors");
  }
  return text;
}

std::string score_text(const assessment::Score& score) {
  if (score.value) {
    std::string text = number_text(*score.value, 0) + " of 100";
    if (score.reason == "critical_error") text += ", for a critical error";
    return text;
  }
  constexpr std::pair<std::string_view, std::string_view> kReasons[] = {
      {"no_expert_set", "consultants have set no standard"},
      {"of_the_set", "those whose attempts set the standard are not scored against it"},
      {"missing_metric", "a metric that it needs has no value"},
      {"other_version", "the standard is for another version of a metric; recompute, or set the standard again"}};
  for (const auto& [code, words] : kReasons)
    if (code == score.reason) return "none: " + std::string(words);
  return "none: the attempt is not graded";
}

std::string proficiency_text(int missing) {
  if (missing == 0) return "You are proficient here: two passes in a row.";
  return missing == 1 ? "One more pass, at the next attempt, and you are proficient here."
                      : "Two passes in a row make you proficient here.";
}

std::string experts_text(const assessment::ExpertSet& set) {
  const std::string needed = std::to_string(assessment::kStandardConsultants) + " consultants with " +
                             std::to_string(assessment::kFamiliarAttempts) + " completed attempts each";
  if (set.standard())
    return "Standard of " + counted(set.people, "consultant", "consultants") + ", the last " +
           std::to_string(assessment::kCountedAttempts) + " attempts of each, set on " +
           utc_text(set.set_us).substr(0, 10) + ", " + set.id + ".";
  if (set.people == 0) return "No expert has set a standard yet; that takes " + needed + ".";
  if (set.enough_people())
    return "Provisional: " + counted(set.people, "consultant has", "consultants have") +
           " made enough attempts; a director can set the standard.";
  return "Provisional: " + counted(set.people, "consultant has", "consultants have") +
         " made enough attempts; a standard takes " + needed + ".";
}

std::string band_text(const assessment::ExpertSet& set, std::string_view metric_id, int version) {
  const assessment::MetricBand* band = set.standard() ? set.find(metric_id, version) : nullptr;
  if (band == nullptr || band->unit == "bool") return "";
  return assessment::plain_range(band->low, band->high, band->unit);
}

std::string tolerance_text(const assessment::ExpertSet& set, std::string_view metric_id, int version) {
  if (set.standard() && set.only_other_version(metric_id, version))
    return "not comparable: the standard is for another version of this metric";
  const assessment::MetricBand* band = set.standard() ? set.find(metric_id, version) : nullptr;
  if (band == nullptr || !band->tolerance) return "";
  return "n = " + std::to_string(band->n) + ", tolerance " +
         assessment::plain_range(band->tolerance->low, band->tolerance->high, band->unit);
}

std::string bands_note() {
  const auto percent = [](double share) { return number_text(100.0 * share, 0) + " %"; };
  return "A band runs from the 10th to the 90th percentile of n consultants, one value each: the median of their "
         "last " +
         std::to_string(assessment::kCountedAttempts) + " attempts. Its tolerance interval holds " +
         percent(assessment::kToleranceShare) + " of all consultants with " +
         percent(assessment::kToleranceConfidence) + " confidence, if they are normally distributed.";
}

}  // namespace seldinger::reports
