#include "app/attempts/attempt_line.h"

#include <cstdio>

#include "reports/words/attempt_words.h"
#include "reports/words/grade_words.h"

namespace seldinger::app {
namespace {

std::string value_of(const std::vector<assessment::MetricValue>& metrics, const char* id, const char* format) {
  for (const assessment::MetricValue& metric : metrics)
    if (metric.id == id && metric.value) {
      char text[32];
      std::snprintf(text, sizeof text, format, *metric.value);
      return text;
    }
  return "–";
}

}  // namespace

std::string outcome_text(assessment::Verdict verdict, const std::vector<assessment::MetricValue>& metrics) {
  char line[160];
  std::snprintf(line, sizeof line, "%-12s hit %s  %6s mm from the centre  %6s s",
                reports::verdict_word(verdict).c_str(), value_of(metrics, "hit", "%.0f").c_str(),
                value_of(metrics, "tip_target_dist", "%.1f").c_str(),
                value_of(metrics, "time_total", "%.1f").c_str());
  return line;
}

std::string maker_text(const casedb::AttemptHead& attempt, const std::string& name) {
  if (attempt.synthetic())
    return reports::simulated_operator_text(attempt.operator_name) + ", seed " + std::to_string(attempt.seed);
  return name.empty() ? "erased person" : name;
}

}  // namespace seldinger::app
