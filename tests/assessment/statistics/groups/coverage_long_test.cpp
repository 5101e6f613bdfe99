// How often intervals hold the truth and tests find what is there, by 20,000 runs of fixed seeds. Every figure is
// printed; those that theory knows are held.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/groups/brunner_munzel.h"
#include "assessment/statistics/groups/describe.h"
#include "assessment/statistics/groups/effect_sizes.h"
#include "assessment/statistics/groups/mann_whitney.h"
#include "assessment/statistics/groups/power.h"
#include "assessment/statistics/groups/rank_sums.h"
#include "assessment/statistics/groups/t_tests.h"
#include "sim/base/rng.h"
#include "tests/assessment/statistics/groups/runs.h"
#include "tests/assessment/statistics/groups/tables.h"

namespace seldinger::assessment::statistics {
namespace {

struct Coverage {
  const char* name;
  std::size_t n;
  double share;
};

Coverage coverage(const char* name, std::size_t n, double truth,
                  const std::function<std::optional<Interval>(base::Rng&)>& interval) {
  const double share = share_of_runs(
      [&](base::Rng& rng) {
        const std::optional<Interval> found = interval(rng);
        return found && found->low <= truth && truth <= found->high;
      },
      900 + n);
  std::printf("coverage %-18s n %3zu: %.4f\n", name, n, share);
  return {name, n, share};
}

void expect_coverage(const Coverage& found, double theory) {
  EXPECT_NEAR(found.share, theory, 3.0 * standard_error(theory)) << found.name << " " << found.n;
}

TEST(GroupsCoverage, CoverageOfWhatTheoryKnows) {
  for (const std::size_t n : {12, 30, 100}) {
    expect_coverage(
        coverage("mean", n, 5.0,
                 [&](base::Rng& rng) { return describe(table_of(normal_sample(rng, n, 5.0, 2.0)), {}).ci95; }),
        0.95);
    expect_coverage(coverage("student", n, 1.0,
                             [&](base::Rng& rng) {
                               const auto a = normal_sample(rng, n, 1.0, 1.0);
                               return pooled_difference(a, normal_sample(rng, n, 0.0, 1.0)).interval(0.95);
                             }),
                    0.95);
    expect_coverage(coverage("d = 0.8", n, 0.8,
                             [&](base::Rng& rng) {
                               const auto a = normal_sample(rng, n, 0.8, 1.0);
                               return cohen_d(a, normal_sample(rng, n, 0.0, 1.0)).ci95;
                             }),
                    0.95);
  }
}

TEST(GroupsCoverage, CoverageOfWelch) {
  for (const std::size_t n : {12, 30, 100})
    for (const double ratio : {1.0, 3.0}) {
      const Coverage found = coverage(ratio == 1.0 ? "welch" : "welch, SD ratio 3", n, 1.0, [&](base::Rng& rng) {
        const auto a = normal_sample(rng, n, 1.0, 1.0);
        return welch_difference(a, normal_sample(rng, n, 0.0, ratio)).interval(0.95);
      });
      EXPECT_GE(found.share, 0.94);
      EXPECT_LE(found.share, 0.96);
    }
}

TEST(GroupsCoverage, CoverageOfHodgesLehmann) {
  for (const std::size_t n : {12, 30, 100}) {
    const Coverage found = coverage("hodges_lehmann", n, 1.0, [&](base::Rng& rng) {
      const auto a = normal_sample(rng, n, 1.0, 1.0);
      return hodges_lehmann(a, normal_sample(rng, n, 0.0, 1.0)).ci95;
    });
    if (2 * n > kMostExact) {
      EXPECT_NEAR(found.share, 0.95, 0.01);
      continue;
    }
    std::vector<int> ranks(2 * n);
    std::iota(ranks.begin(), ranks.end(), 1);
    const std::vector<double> chances = chances_of_draws(ranks, n);
    const auto of_u = std::span(chances).subspan(n * (n + 1) / 2);
    const std::size_t k = critical_sum(of_u, 0.025);
    expect_coverage(found,
                    1.0 - 2.0 * std::accumulate(of_u.begin(), of_u.begin() + static_cast<std::ptrdiff_t>(k), 0.0));
  }
  coverage("hodges_lehmann tied", 12, 1.0, [&](base::Rng& rng) {
    auto a = normal_sample(rng, 12, 1.0, 1.5), b = normal_sample(rng, 12, 0.0, 1.5);
    for (double& value : a) value = std::round(value);
    for (double& value : b) value = std::round(value);
    return hodges_lehmann(a, b).ci95;
  });
}

// Approximations. What falls below .93 is said by the answer itself.
TEST(GroupsCoverage, CoverageOfApproximations) {
  for (const std::size_t n : {6, 12, 30, 100})
    for (const double d : {0.0, 0.8, 1.6}) {
      const double superior = normal_cdf(d / std::sqrt(2.0));
      const auto with_two = [&](const char* name, double truth, auto effect_of) {
        return coverage((std::string(name) + ", d = " + std::to_string(d).substr(0, 3)).c_str(), n, truth,
                        [&](base::Rng& rng) -> std::optional<Interval> {
                          const auto a = normal_sample(rng, n, d, 1.0);
                          return effect_of(a, normal_sample(rng, n, 0.0, 1.0)).ci95;
                        })
            .share;
      };
      EXPECT_GE(with_two("cliff_delta", 2.0 * superior - 1.0, cliff_delta), 0.80);
      EXPECT_GE(with_two("cliff_delta_logit", 2.0 * superior - 1.0, cliff_delta_by_superiority), 0.93);
      EXPECT_GE(with_two("glass_delta", d, glass_delta), 0.93);
      EXPECT_GE(with_two("d_unpooled", d, unpooled_d), 0.93);
    }
  const Answer answer = effect_size(table_of({{"a", {1, 2, 3, 4}}, {"b", {2, 3, 5, 6}}}), {});
  EXPECT_TRUE(std::any_of(answer.notes.begin(), answer.notes.end(), [](const std::string& note) {
    return note.find("holds 83 to 95 %") != std::string::npos;
  }));
}

TEST(GroupsCoverage, PowerIsWhatIsPlanned) {
  const auto power_of = [](const char* name, double theory, const std::function<double(base::Rng&)>& p_value) {
    const double share = share_of_runs([&](base::Rng& rng) { return p_value(rng) <= kAlpha; }, 4242);
    std::printf("power %-30s theory %.4f, found %.4f\n", name, theory, share);
    return share;
  };
  for (const auto& [n1, n2, d] : {std::tuple(14, 26, 0.8), {20, 20, 1.0}, {12, 12, 0.5}}) {
    const double theory = t_test_power(n1, n2, d, kAlpha);
    const auto samples = [n1 = n1, n2 = n2, d = d](base::Rng& rng) {
      auto a = normal_sample(rng, static_cast<std::size_t>(n1), d, 1.0);
      return std::pair(std::move(a), normal_sample(rng, static_cast<std::size_t>(n2), 0.0, 1.0));
    };
    const double student_power = power_of("student", theory, [&](base::Rng& rng) {
      const auto [a, b] = samples(rng);
      return pooled_difference(a, b).p_value();
    });
    EXPECT_NEAR(student_power, theory, 2.0 * standard_error(theory));
    const double welch_power = power_of("welch, equal SD", theory, [&](base::Rng& rng) {
      const auto [a, b] = samples(rng);
      return welch_difference(a, b).p_value();
    });
    EXPECT_NEAR(welch_power, theory, 0.02);
    const double probability = normal_cdf(d / std::sqrt(2.0));
    const Answer noether = power(
        {}, with({{"n1", std::to_string(n1)}, {"n2", std::to_string(n2)}, {"p", std::to_string(probability)}}));
    const double rank_power = power_of("mann_whitney (Noether)", *noether.estimate, [&](base::Rng& rng) {
      const auto [a, b] = samples(rng);
      return exact_rank_sum(a, b).p_value;
    });
    EXPECT_NEAR(rank_power, *noether.estimate, 0.06);
  }
  // What an answer says would have been found with 80 % power.
  const double d_z = detectable_errors(19.0, kPlannedPower, kAlpha) / std::sqrt(20.0);
  const double paired_power = power_of("paired at the detectable d_z", kPlannedPower, [&](base::Rng& rng) {
    return mean_of(normal_sample(rng, 20, d_z, 1.0)).p_value();
  });
  EXPECT_NEAR(paired_power, kPlannedPower, 2.0 * standard_error(kPlannedPower));
}

}  // namespace
}  // namespace seldinger::assessment::statistics
