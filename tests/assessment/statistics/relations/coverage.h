// How often intervals hold what is true, over simulated samples; printed, and held against what is promised.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "tests/assessment/statistics/relations/random_tables.h"

namespace seldinger::fixtures {

// What an answer says where simulated intervals fall below .93, tests above .06.
inline bool warns_of(const Answer& answer, const std::string& words) {
  return std::any_of(answer.notes.begin(), answer.notes.end(),
                     [&](const std::string& note) { return note.find(words) != std::string::npos; });
}
inline constexpr const char* kCoversTooLittle = "fewer than 93 of 100";
inline constexpr const char* kRejectsTooMuch = "more than 6 of 100";

// An interval, open where there is no bound; nothing: the answer has none.
struct Limits {
  double low = -INFINITY, high = INFINITY;
};

struct Covered {
  std::size_t runs = 0, without = 0, covered = 0, warned = 0;
  double share() const { return static_cast<double>(covered) / static_cast<double>(runs - without); }
  // Three standard errors of a share near .95.
  double three_errors() const { return 3.0 * std::sqrt(0.95 * 0.05 / static_cast<double>(runs - without)); }
};

using Sample = std::function<Answer(RandomTables&, std::size_t n)>;
using LimitsOf = std::function<std::optional<Limits>(const Answer&)>;

inline std::optional<Limits> limits_of(const Answer& answer) {
  if (!answer.ci95) return std::nullopt;
  return Limits{answer.ci95->low, answer.ci95->high};
}
// Without an upper bound the lower one stands in `more`.
inline LimitsOf limits_or_lower(const std::string& lower) {
  return [lower](const Answer& answer) -> std::optional<Limits> {
    if (answer.ci95) return Limits{answer.ci95->low, answer.ci95->high};
    if (!std::isnan(named(answer, lower))) return Limits{named(answer, lower), INFINITY};
    return std::nullopt;
  };
}

inline Covered coverage_of(const std::string& what, std::size_t n, double truth, const Sample& sample,
                           const LimitsOf& limits = limits_of, std::size_t runs = 20000) {
  RandomTables random(stream_of(what, n));
  Covered found{.runs = runs};
  for (std::size_t run = 0; run < runs; ++run) {
    const Answer answer = sample(random, n);
    const std::optional<Limits> got = limits(answer);
    found.without += !got;
    found.covered += got && got->low <= truth && truth <= got->high;
    found.warned += got && warns_of(answer, kCoversTooLittle);
  }
  std::printf("  coverage  %-52s n %3zu  %.4f  without interval %.4f  warned %.2f\n", what.c_str(), n,
              found.share(), static_cast<double>(found.without) / static_cast<double>(runs),
              static_cast<double>(found.warned) / static_cast<double>(runs - found.without));
  return found;
}

// Asymptotic: what it covers is printed, and below .93 the answers say so themselves.
inline void expect_published(const std::string& what, double truth, const Sample& sample,
                             const LimitsOf& limits = limits_of, std::size_t runs = 20000) {
  for (const std::size_t n : {12, 30, 100}) {
    const Covered got = coverage_of(what, n, truth, sample, limits, runs);
    EXPECT_LT(got.without, runs / 2) << what << ", n " << n;
    if (got.share() < 0.93) {
      EXPECT_EQ(got.warned, runs - got.without) << what << ", n " << n;
    }
    EXPECT_GT(got.share(), 0.80) << what << ", n " << n;
    EXPECT_LE(got.share(), 1.0);
  }
}

}  // namespace seldinger::fixtures
