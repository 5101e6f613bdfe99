#include "assessment/statistics/growth/binary_cusum.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "sim/base/check.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr double kLimitAbove = 1e-8;              // of the sum that must not suffice: more than kSumSlack
constexpr double kWholeMass = 1e-14;              // of a cycle that may stay unfinished
constexpr std::size_t kLongestCycle = 1'000'000;  // attempts

// From S = 0 the sum sets out again and again, like a new chart each time: a cycle ends at the limit or back at 0.
// Within a cycle S is a number of ups and downs alone, so that few sums can occur after so many attempts.
class Cycle {
 public:
  Cycle(const CusumSteps& steps, double p_up, double limit) : steps_(steps), p_up_(p_up), limit_(limit) {}

  // One attempt further: how probable it is that the cycle ends with it, at the limit and at 0.
  std::pair<double, double> advance() {
    double at_limit = 0.0, at_zero = 0.0;
    ++attempts_;
    next_.clear();
    for (const State& state : live_) {
      go(state.downs, p_up_ * state.mass, at_limit, at_zero);
      go(state.downs + 1, (1.0 - p_up_) * state.mass, at_limit, at_zero);
    }
    live_.swap(next_);
    return {at_limit, at_zero};
  }

  double mass() const {
    double sum = 0.0;
    for (const State& state : live_) sum += state.mass;
    return sum;
  }

 private:
  struct State {
    std::size_t downs;
    double mass;
  };

  void go(std::size_t downs, double mass, double& at_limit, double& at_zero) {
    const double sum =
        static_cast<double>(attempts_ - downs) * steps_.up - static_cast<double>(downs) * steps_.down;
    if (sum >= limit_ - kSumSlack) {
      at_limit += mass;
    } else if (sum <= kSumSlack) {
      at_zero += mass;
    } else if (!next_.empty() && next_.back().downs == downs) {
      next_.back().mass += mass;
    } else {
      next_.push_back({downs, mass});
    }
  }

  CusumSteps steps_;
  double p_up_, limit_;
  std::size_t attempts_ = 0;
  std::vector<State> live_{{0, 1.0}}, next_;  // by downs, rising
};

}  // namespace

std::vector<double> reaching(const CusumSteps& steps, double p_up, double limit, std::size_t attempts) {
  CHECK(steps.up > 0.0 && steps.down > 0.0 && p_up >= 0.0 && p_up <= 1.0);
  std::vector<double> ends(attempts + 1), returns(attempts + 1);
  Cycle cycle(steps, p_up, limit);
  for (std::size_t t = 1; t <= attempts; ++t) std::tie(ends[t], returns[t]) = cycle.advance();
  // How probable it is that a cycle begins after attempt t, and that the limit is reached at it: a renewal.
  std::vector<double> begins(attempts + 1), reached(attempts + 1);
  begins[0] = 1.0;
  for (std::size_t t = 1; t <= attempts; ++t)
    for (std::size_t length = 1; length <= t; ++length) {
      begins[t] += begins[t - length] * returns[length];
      reached[t] += begins[t - length] * ends[length];
    }
  reached.erase(reached.begin());
  return reached;
}

double reached_within(const CusumSteps& steps, double p_up, double limit, std::size_t attempts) {
  double sum = 0.0;
  for (const double one : reaching(steps, p_up, limit, attempts)) sum += one;
  return std::min(1.0, sum);
}

std::optional<double> limit_for(const CusumSteps& steps, double p_up, double permitted, std::size_t attempts) {
  double low = 0.0, high = static_cast<double>(attempts) * steps.up;
  if (!(reached_within(steps, p_up, high, attempts) <= permitted)) return std::nullopt;
  while (high - low > kSumSlack) {
    const double middle = 0.5 * (low + high);
    (reached_within(steps, p_up, middle, attempts) <= permitted ? high : low) = middle;
  }
  return std::min(high + kLimitAbove, static_cast<double>(attempts) * steps.up);
}

double run_length(const CusumSteps& steps, double p_up, double limit) {
  CHECK(steps.up > 0.0 && steps.down > 0.0 && p_up >= 0.0 && p_up <= 1.0);
  Cycle cycle(steps, p_up, limit);
  double at_limit = 0.0, length = 0.0;
  for (std::size_t t = 1; cycle.mass() > kWholeMass; ++t) {
    if (t > kLongestCycle) return std::numeric_limits<double>::quiet_NaN();
    const auto [ends, returns] = cycle.advance();
    at_limit += ends;
    length += static_cast<double>(t) * (ends + returns);
  }
  return at_limit > 0.0 ? length / at_limit : std::numeric_limits<double>::quiet_NaN();
}

std::vector<double> cusum_path(const CusumSteps& steps, const std::vector<bool>& ups) {
  std::vector<double> path;
  double sum = 0.0;
  for (const bool up : ups) path.push_back(sum = std::max(0.0, sum + (up ? steps.up : -steps.down)));
  return path;
}

}  // namespace seldinger::assessment::statistics
