#include "reports/learning/cut_words.h"

#include "assessment/grading/plain_words.h"
#include "assessment/registry.h"
#include "reports/studies/study_words.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

std::string unit_of(const casedb::Cut& cut) {
  const assessment::MetricInfo* info = assessment::find_metric(cut.metric_id);
  return info == nullptr ? "share" : info->unit;
}

}  // namespace

std::string cut_method_text(const std::string& method) {
  if (method == "contrasting_groups") return "Contrasting groups";
  if (method == "borderline") return "Borderline persons";
  if (method == "angoff") return "Angoff";
  if (method == "hofstee") return "Hofstee";
  return method;
}

std::string cut_scale_text(const casedb::Cut& cut) {
  if (cut.metric_id.empty()) return "Share of items that are right";
  return metric_label(cut.metric_id) + ", " + unit_of(cut);
}

std::string cut_text(const casedb::Cut& cut) {
  const std::string what = cut.metric_id.empty() ? "Share of items" : metric_label(cut.metric_id);
  return what + (cut.higher_is_better ? " at least " : " at most ") +
         assessment::plain_value(cut.value, unit_of(cut)) + " (" + interval_text(cut.interval) +
         "), n = " + std::to_string(cut.n) + ", " + cut_method_text(cut.method);
}

std::string cut_standing_text(const casedb::Cut& cut) {
  std::string text = "Proposed by " + cut.proposed_by + ", " + utc_text(cut.proposed_us);
  return text + (cut.frozen_us ? "; frozen by " + cut.frozen_by + ", " + utc_text(*cut.frozen_us) : "; not frozen");
}

}  // namespace seldinger::reports
