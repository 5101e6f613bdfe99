// How often intervals hold what they estimate, over simulated samples: printed, and held to what is promised.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>

#include "assessment/statistics/answer.h"

namespace seldinger::fixtures {

class Coverage {
 public:
  void add(const std::optional<assessment::statistics::Interval>& interval, double truth) {
    if (!interval) {
      ++without_;
      return;
    }
    ++runs_;
    covered_ += interval->low <= truth && truth <= interval->high ? 1 : 0;
  }
  double share() const { return static_cast<double>(covered_) / static_cast<double>(runs_); }
  double standard_error() const { return std::sqrt(0.95 * 0.05 / static_cast<double>(runs_)); }
  void print(const std::string& what) const {
    std::printf("coverage  %-46s %.4f  (%zu runs, %zu without an interval)\n", what.c_str(), share(), runs_,
                without_);
    std::fflush(stdout);
  }
  // Of an interval that is exact in theory.
  void expect_exact(const std::string& what) const {
    print(what);
    EXPECT_LE(std::abs(share() - 0.95), 3.0 * standard_error()) << what;
  }
  // Of one that is not: less than .93 has to be `warned` of by the answer.
  void expect_near_or_warned(const std::string& what, bool warned) const {
    print(what + (warned ? ", warned" : ""));
    EXPECT_TRUE(warned || share() >= 0.93) << what << " " << share();
  }

 private:
  std::size_t runs_ = 0, covered_ = 0, without_ = 0;
};

}  // namespace seldinger::fixtures
