#include "app/attempts/metrics_text.h"

#include <algorithm>
#include <cstdio>

#include "assessment/grading/reason_words.h"

namespace seldinger::app {

void print_metrics(const std::vector<assessment::MetricValue>& metrics) {
  std::size_t longest = 0;
  for (const assessment::MetricValue& metric : metrics) longest = std::max(longest, metric.id.size());
  const int width = static_cast<int>(longest);
  for (const assessment::MetricValue& metric : metrics) {
    if (metric.value)
      std::printf("  %-*s v%d %10.3f %s\n", width, metric.id.c_str(), metric.version, *metric.value,
                  metric.unit.c_str());
    else
      std::printf("  %-*s v%d          – (%s)\n", width, metric.id.c_str(), metric.version,
                  assessment::reason_words(metric.reason).c_str());
  }
}

}  // namespace seldinger::app
