// How often procedures reject what is true, by 20,000 runs of fixed seeds. Every figure is printed; those that
// theory knows are held.
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
#include "assessment/statistics/groups/mann_whitney.h"
#include "assessment/statistics/groups/multiplicity.h"
#include "assessment/statistics/groups/power.h"
#include "assessment/statistics/groups/rank_sums.h"
#include "assessment/statistics/groups/rank_tests.h"
#include "assessment/statistics/groups/signed_rank.h"
#include "assessment/statistics/groups/t_tests.h"
#include "assessment/statistics/groups/variance_analysis.h"
#include "sim/base/rng.h"
#include "tests/assessment/statistics/groups/runs.h"
#include "tests/assessment/statistics/groups/tables.h"

namespace seldinger::assessment::statistics {
namespace {

enum class Shape { kNormal, kLogNormal, kTied };
constexpr Shape kShapes[] = {Shape::kNormal, Shape::kLogNormal, Shape::kTied};
struct Sizes {
  std::size_t n1, n2;
};
constexpr Sizes kSizes[] = {{6, 6}, {8, 16}, {12, 12}, {30, 30}};

const char* name_of(Shape shape) {
  return shape == Shape::kNormal ? "normal" : shape == Shape::kLogNormal ? "log-normal" : "tied";
}

// Around one mean whatever the spread; tied: five points, as of a questionnaire.
double around_one_mean(base::Rng& rng, Shape shape, double spread) {
  const double z = rng.normal();
  if (shape == Shape::kNormal) return spread * z;
  if (shape == Shape::kLogNormal) return spread * (std::exp(z) - std::exp(0.5));
  return std::clamp(std::round(spread * z), -2.0, 2.0);
}

// So that neither tends to be larger whatever the spread: one median, and symmetric once the logarithm is taken.
double around_one_median(base::Rng& rng, Shape shape, double spread) {
  return shape == Shape::kLogNormal ? std::exp(spread * rng.normal()) : around_one_mean(rng, shape, spread);
}

using Draw = double (*)(base::Rng&, Shape, double);

std::vector<double> sample(base::Rng& rng, Draw draw, Shape shape, double spread, std::size_t n) {
  std::vector<double> values;
  for (std::size_t i = 0; i < n; ++i) values.push_back(draw(rng, shape, spread));
  return values;
}

using PValue = std::function<double(const std::vector<double>&, const std::vector<double>&)>;

struct Cell {
  Sizes sizes;
  Shape shape;
  double ratio;  // of the second group's spread to the first's
  double size = 0.0;

  bool same_distribution() const { return ratio == 1.0; }
};

// A test that gives no answer, as of values that do not vary, rejects nothing.
std::vector<Cell> sizes_over_grid(const char* name, Draw draw, const PValue& p_value) {
  std::vector<Cell> cells;
  for (const Sizes& sizes : kSizes)
    for (const Shape shape : kShapes)
      for (const double ratio : {1.0, 3.0}) {
        Cell cell{sizes, shape, ratio};
        cell.size = share_of_runs(
            [&](base::Rng& rng) {
              const std::vector<double> a = sample(rng, draw, shape, 1.0, sizes.n1);
              return p_value(a, sample(rng, draw, shape, ratio, sizes.n2)) <= kAlpha;
            },
            17 * sizes.n1 + sizes.n2);
        std::printf("size %-16s %2zu/%-2zu %-10s SD ratio %.0f: %.4f\n", name, sizes.n1, sizes.n2, name_of(shape),
                    ratio, cell.size);
        cells.push_back(cell);
      }
  return cells;
}

double upper_bound(double size) {
  return size + 3.0 * standard_error(size);
}

TEST(GroupsSize, SizeOfWelch) {
  const auto cells = sizes_over_grid("welch", around_one_mean, [](const auto& a, const auto& b) {
    const MeanDifference difference = welch_difference(a, b);
    return difference.reason == nullptr ? difference.p_value() : 1.0;
  });
  for (const Cell& cell : cells)
    if (cell.shape == Shape::kNormal) {
      EXPECT_GE(cell.size, 0.04);
      EXPECT_LE(cell.size, 0.06);
    }
}

TEST(GroupsSize, SizeOfWelchAnovaOfThree) {
  for (const Sizes& sizes : kSizes)
    for (const Shape shape : kShapes)
      for (const double ratio : {1.0, 3.0}) {
        const double size = share_of_runs(
            [&](base::Rng& rng) {
              std::vector<Group> groups;
              for (const auto& [n, spread] : {std::pair(sizes.n1, 1.0), {sizes.n2, ratio}, {sizes.n1, 1.0}})
                groups.push_back({"", sample(rng, around_one_mean, shape, spread, n)});
              const FTest test = welch_one_way(groups);
              return test.reason == nullptr && test.p_value() <= kAlpha;
            },
            sizes.n1 + 31 * sizes.n2);
        std::printf("size %-16s %2zu/%zu/%-2zu %-10s SD ratio %.0f: %.4f\n", "welch_anova", sizes.n1, sizes.n2,
                    sizes.n1, name_of(shape), ratio, size);
        if (shape == Shape::kNormal) {
          EXPECT_GE(size, 0.04);
          EXPECT_LE(size, 0.06);
        }
      }
}

// What the exact test of untied values rejects: its largest p-value that .05 holds.
double enumerated_size(std::size_t n1, std::size_t n2) {
  std::vector<int> ranks(n1 + n2);
  std::iota(ranks.begin(), ranks.end(), 1);
  const std::vector<double> chances = chances_of_draws(ranks, n1);
  double size = 0.0;
  for (int s = 0; s < static_cast<int>(chances.size()); ++s) {
    const double p = exact_test(chances, s, static_cast<int>(n1 * (n1 + n2 + 1))).two_sided;
    if (p <= kAlpha) size = std::max(size, p);
  }
  return size;
}

TEST(GroupsSize, SizeOfMannWhitney) {
  const auto cells = sizes_over_grid("mann_whitney", around_one_median,
                                     [](const auto& a, const auto& b) { return exact_rank_sum(a, b).p_value; });
  for (const Cell& cell : cells) {
    if (!cell.same_distribution()) continue;
    EXPECT_LE(cell.size, upper_bound(kAlpha));
    if (cell.shape == Shape::kTied) continue;
    const double enumerated = enumerated_size(cell.sizes.n1, cell.sizes.n2);
    EXPECT_NEAR(cell.size, enumerated, 3.0 * standard_error(enumerated));
  }
}

TEST(GroupsSize, SizeOfBrunnerMunzel) {
  const auto cells = sizes_over_grid("brunner_munzel", around_one_median, [](const auto& a, const auto& b) {
    // 1,000 draws where the product takes 10,000: as valid, and a tenth of the time.
    if (std::min(a.size(), b.size()) < 15) return studentised_permutation(a, b, 1'000, 1).p_value;
    const Superiority found = superiority(a, b);
    return found.error > 0.0 ? 2.0 * student_t_upper(std::abs(found.statistic()), found.df) : 1.0;
  });
  for (const Cell& cell : cells)
    if (cell.same_distribution() && cell.sizes.n1 < 15) {
      EXPECT_LE(cell.size, upper_bound(kAlpha)) << cell.sizes.n1 << name_of(cell.shape);
    }
}

TEST(GroupsSize, SizeOfSignedRank) {
  for (const std::size_t n : {6, 8, 12, 30})
    for (const Shape shape : {Shape::kNormal, Shape::kTied}) {
      const double size = share_of_runs(
          [&](base::Rng& rng) {
            const SignedRankTest test = exact_signed_rank(sample(rng, around_one_mean, shape, 1.0, n), false);
            return test.reason == nullptr && test.p_value <= kAlpha;
          },
          n);
      std::printf("size %-16s %zu %-10s: %.4f\n", "wilcoxon", n, name_of(shape), size);
      EXPECT_LE(size, upper_bound(kAlpha));
      if (shape == Shape::kTied) continue;
      std::vector<int> ranks(n);
      std::iota(ranks.begin(), ranks.end(), 1);
      const std::vector<double> chances = chances_of_signs(ranks);
      double enumerated = 0.0;
      for (int s = 0; s < static_cast<int>(chances.size()); ++s) {
        const double p = exact_test(chances, s, static_cast<int>(n * (n + 1) / 2)).two_sided;
        if (p <= kAlpha) enumerated = std::max(enumerated, p);
      }
      EXPECT_NEAR(size, enumerated, 3.0 * standard_error(enumerated));
    }
}

// Three outcomes that go together; falsely significant is any of them.
TEST(GroupsSize, FamilySizeOfMaxT) {
  for (const Sizes& sizes : {Sizes{6, 6}, Sizes{8, 16}}) {
    std::vector<char> is_first(sizes.n1 + sizes.n2, 0);
    std::fill_n(is_first.begin(), sizes.n1, char{1});
    const double size = share_of_runs(
        [&](base::Rng& rng) {
          std::vector<std::vector<double>> outcomes(3, std::vector<double>(is_first.size()));
          for (std::size_t i = 0; i < is_first.size(); ++i) {
            const double common = rng.normal();
            for (std::vector<double>& outcome : outcomes) outcome[i] = common + rng.normal();
          }
          const MaxT test = max_t_test(outcomes, is_first, 1'000, 1);
          return *std::min_element(test.adjusted.begin(), test.adjusted.end()) <= kAlpha;
        },
        sizes.n1);
    std::printf("size %-16s %2zu/%-2zu three outcomes, normal: %.4f\n", "max_t", sizes.n1, sizes.n2, size);
    EXPECT_LE(size, upper_bound(kAlpha));
  }
}

// Approximations: printed.
TEST(GroupsSize, SizeOfApproximations) {
  for (const std::size_t n : {6, 12, 30}) {
    const auto three = [&](base::Rng& rng) {
      std::vector<Group> groups;
      for (const char* name : {"a", "b", "c"})
        groups.push_back({name, sample(rng, around_one_mean, Shape::kNormal, 1.0, n)});
      return groups;
    };
    const auto size_of = [&](const std::function<double(const std::vector<Group>&)>& p_value) {
      return share_of_runs([&](base::Rng& rng) { return p_value(three(rng)) <= kAlpha; }, n);
    };
    const double kruskal_size = size_of([](const auto& groups) { return *kruskal(table_of(groups), {}).p_value; });
    const double trend = size_of([](const auto& groups) { return normal_upper(jonckheere_trend(groups).z()); });
    const double blocks =
        size_of([](const auto& groups) { return *friedman(table_of_persons(groups), {}).p_value; });
    const double spreads =
        size_of([](const auto& groups) { return *brown_forsythe(table_of(groups), {}).p_value; });
    std::printf("size of three groups of %zu: kruskal %.4f, jonckheere %.4f, friedman %.4f, brown_forsythe %.4f\n",
                n, kruskal_size, trend, blocks, spreads);
    for (const double size : {kruskal_size, trend, blocks, spreads}) {
      EXPECT_GT(size, 0.01);
      EXPECT_LT(size, 0.06);
    }
  }
}

}  // namespace
}  // namespace seldinger::assessment::statistics
