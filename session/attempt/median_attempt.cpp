#include "session/attempt/median_attempt.h"

#include <cmath>
#include <limits>
#include <string>

#include "sim/base/check.h"

namespace seldinger::session {
namespace {

using Attempts = std::vector<std::vector<assessment::MetricValue>>;

std::vector<double> values_of(const Attempts& attempts, const std::string& id) {
  std::vector<double> values;
  for (const auto& metrics : attempts) {
    double value = std::numeric_limits<double>::infinity();  // none: behind all
    for (const assessment::MetricValue& metric : metrics)
      if (metric.id == id && metric.value) value = *metric.value;
    values.push_back(value);
  }
  return values;
}

// Of each value, its rank less the middle one, from −(n−1)/2 to (n−1)/2.
std::vector<double> ranks_off_middle(const std::vector<double>& values) {
  std::vector<double> off;
  for (const double value : values) {
    double below = 0.0, above = 0.0;
    for (const double other : values) {
      below += other < value ? 1.0 : 0.0;
      above += other > value ? 1.0 : 0.0;
    }
    off.push_back((below - above) / 2.0);
  }
  return off;
}

}  // namespace

std::size_t index_of_median(const Attempts& attempts) {
  CHECK(!attempts.empty());
  std::vector<double> sum(attempts.size(), 0.0), off_hit(attempts.size(), 0.0);
  for (const assessment::MetricValue& metric : attempts.front()) {
    const std::vector<double> off = ranks_off_middle(values_of(attempts, metric.id));
    for (std::size_t i = 0; i < off.size(); ++i) {
      sum[i] += std::abs(off[i]);
      if (metric.id == "hit") off_hit[i] = std::abs(off[i]);
    }
  }
  std::size_t best = 0;
  for (std::size_t i = 1; i < attempts.size(); ++i)
    if (off_hit[i] < off_hit[best] || (off_hit[i] == off_hit[best] && sum[i] < sum[best])) best = i;
  return best;
}

}  // namespace seldinger::session
