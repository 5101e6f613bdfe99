// Prints every metric and step of the sample attempts with all their bits. Built twice with other compiler options
// (CMakeLists.txt); builds_test compares what the builds print.
#include <cstdio>

#include "assessment/procedure/steps.h"
#include "assessment/registry.h"
#include "tests/assessment/metrics/sample_attempts.h"

using namespace seldinger::assessment;

int main() {
  for (const SampleKind& kind : kSampleKinds)
    for (const double rate_hz : {100.0, 1000.0}) {
      const SampleAttempt sample = sample_attempt(kind, {rate_hz});
      const auto signals = sample.signals();
      if (!signals) return 1;
      for (const MetricValue& metric : measure_all(*signals)) {
        std::printf("%s/%g/%s ", sample.name.c_str(), rate_hz, metric.id.c_str());
        if (metric.value)
          std::printf("%a\n", *metric.value);
        else
          std::printf("null\n");
      }
      for (const StepResult& step : walk_steps(*signals))
        std::printf("%s/%g/%s %a\n", sample.name.c_str(), rate_hz, step.id.c_str(),
                    step.t_s.value_or(-1.0) + 1e3 * static_cast<double>(step.state));
    }
  return 0;
}
