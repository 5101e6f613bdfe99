#include "reports/words/grade_words.h"

#include "assessment/grading/plain_words.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

using assessment::Verdict;

std::string counted(std::size_t n, const char* one, const char* many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

}  // namespace

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
      {"no_expert_set", "too few consultants have made attempts"},
      {"of_the_set", "whose attempts set the standard is not scored against it"},
      {"missing_metric", "a metric that it needs has no value"},
      {"no_spread", "the consultants do not differ"}};
  for (const auto& [code, words] : kReasons)
    if (code == score.reason) return "none: " + std::string(words);
  return "none: the attempt is not graded";
}

std::string experts_text(const assessment::ExpertSet& set) {
  const std::string needed = std::to_string(assessment::kStandardConsultants) + " consultants with " +
                             std::to_string(assessment::kStandardAttempts) + " attempts each";
  if (set.kind == assessment::SetKind::simulated)
    return "Simulated expert, not a standard: " + counted(set.attempt_ids.size(), "attempt", "attempts") +
           ". A standard takes " + needed + ".";
  if (set.id.empty()) return "No expert has set a standard yet; that takes " + needed + ".";
  std::string text = counted(set.person_ids.size(), "consultant", "consultants") + ", " +
                     counted(set.attempt_ids.size(), "attempt", "attempts") + ", the last on " +
                     utc_text(set.newest_us).substr(0, 10) + ", set " + set.id + ".";
  if (set.bands.empty())
    text += " Bands are shown from " + std::to_string(assessment::kLeastShown) + " consultants on.";
  if (!set.standard()) text += " Provisional: a standard takes " + needed + ".";
  return text;
}

std::string band_text(const assessment::ExpertSet& set, std::string_view metric_id, int version) {
  const assessment::MetricBand* band = set.find(metric_id, version);
  if (band == nullptr || band->unit == "bool") return "";
  return assessment::plain_range(band->low, band->high, band->unit);
}

}  // namespace seldinger::reports
