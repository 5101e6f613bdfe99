#include "reports/words/shown_metrics.h"

#include "assessment/registry.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

template <typename Wanted>
std::vector<const casedb::MetricValue*> those(const casedb::AttemptRow& row, const Wanted& wanted) {
  const assessment::Manner manner{row.picture.modality, row.approach, row.instrument.kind};
  std::vector<const casedb::MetricValue*> found;
  for (const casedb::MetricValue& metric : row.metrics)
    if (assessment::applies(metric, manner) && wanted(metric)) found.push_back(&metric);
  return found;
}

bool absent(const casedb::MetricValue& metric) {
  return !metric.value && assessment::absent_from_case(metric.reason);
}

}  // namespace

std::vector<const casedb::MetricValue*> shown_metrics(const casedb::AttemptRow& row, std::string_view group) {
  return those(
      row, [&](const casedb::MetricValue& metric) { return !absent(metric) && metric_group(metric.id) == group; });
}

std::vector<const casedb::MetricValue*> absent_metrics(const casedb::AttemptRow& row) {
  return those(row, absent);
}

}  // namespace seldinger::reports
