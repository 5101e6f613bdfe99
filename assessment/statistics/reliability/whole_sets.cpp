#include "assessment/statistics/reliability/whole_sets.h"

#include <algorithm>
#include <cmath>

namespace seldinger::assessment::statistics {
namespace {

constexpr std::size_t kMostSteps = 20'000'000;
constexpr double kHalvesRounding = 1e-9;

// Ascending sets, depth first; what is left to choose is held to the sum and to the squares about the reported
// mean.
class SetSearch {
 public:
  SetSearch(const ReportedScale& reported, std::size_t most) : n_(reported.n), most_(most) {
    const double items = static_cast<double>(reported.items), n = static_cast<double>(n_);
    mean_ = reported.mean * items;
    mean_half_ = 0.5 * std::pow(10.0, -static_cast<double>(reported.mean_decimals)) * items + kHalvesRounding;
    sd_ = *reported.sd * items;
    sd_half_ = 0.5 * std::pow(10.0, -static_cast<double>(reported.sd_decimals)) * items + kHalvesRounding;
    const double high = sd_ + sd_half_, low = std::max(0.0, sd_ - sd_half_);
    most_squares_ = (n - 1.0) * high * high + n * mean_half_ * mean_half_;
    least_squares_ = (n - 1.0) * low * low;
    // Nobody is further from the mean than this (Samuelson's inequality).
    const double furthest = (n - 1.0) / std::sqrt(n) * high + mean_half_;
    lowest_ = static_cast<std::int64_t>(std::ceil(mean_ - furthest - kHalvesRounding));
    highest_ = static_cast<std::int64_t>(std::floor(mean_ + furthest + kHalvesRounding));
    if (reported.low) lowest_ = std::max<std::int64_t>(lowest_, std::llround(*reported.low * items));
    if (reported.high) highest_ = std::min<std::int64_t>(highest_, std::llround(*reported.high * items));
  }

  WholeSets all() {
    chosen_.reserve(n_);
    choose(lowest_, 0.0, 0.0);
    return std::move(found_);
  }

 private:
  void choose(std::int64_t from, double sum, double squares) {
    const double left = static_cast<double>(n_ - chosen_.size()), n = static_cast<double>(n_);
    if (chosen_.size() == n_) return take(sum);
    for (std::int64_t value = from; value <= highest_ && found_.all; ++value) {
      if (++steps_ > kMostSteps) {
        found_.all = false;
        return;
      }
      const double x = static_cast<double>(value), off = x - mean_, further = static_cast<double>(highest_) - mean_;
      if (sum + left * x > n * (mean_ + mean_half_)) return;
      if (sum + x + (left - 1.0) * static_cast<double>(highest_) < n * (mean_ - mean_half_)) continue;
      if (squares + off * off > most_squares_) continue;
      if (squares + off * off + (left - 1.0) * std::max(off * off, further * further) < least_squares_) continue;
      chosen_.push_back(value);
      choose(value, sum + x, squares + off * off);
      chosen_.pop_back();
    }
  }
  void take(double sum) {
    const double mean = sum / static_cast<double>(n_);
    double squares = 0.0;
    for (const std::int64_t one : chosen_)
      squares += (static_cast<double>(one) - mean) * (static_cast<double>(one) - mean);
    const double sd = std::sqrt(squares / (static_cast<double>(n_) - 1.0));
    if (!(std::abs(mean - mean_) <= mean_half_ && std::abs(sd - sd_) <= sd_half_)) return;
    if (found_.first.empty()) found_.first = chosen_;
    if (++found_.count >= most_) found_.all = false;
  }

  std::size_t n_, most_, steps_ = 0;
  double mean_ = 0.0, mean_half_ = 0.0, sd_ = 0.0, sd_half_ = 0.0, most_squares_ = 0.0, least_squares_ = 0.0;
  std::int64_t lowest_ = 0, highest_ = -1;
  std::vector<std::int64_t> chosen_;
  WholeSets found_;
};

}  // namespace

WholeSets whole_sets_of(const ReportedScale& reported, std::size_t most) {
  return SetSearch(reported, most).all();
}

}  // namespace seldinger::assessment::statistics
