// Exact tests against going through every deal and every sign one by one, and what must hold whatever the data.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "assessment/statistics/deals.h"
#include "assessment/statistics/groups/brunner_munzel.h"
#include "assessment/statistics/groups/mann_whitney.h"
#include "assessment/statistics/groups/multiplicity.h"
#include "assessment/statistics/groups/pairwise.h"
#include "assessment/statistics/groups/rank_sums.h"
#include "assessment/statistics/groups/rank_tests.h"
#include "assessment/statistics/groups/signed_rank.h"
#include "assessment/statistics/groups/t_tests.h"
#include "tests/assessment/statistics/groups/random_tables.h"
#include "tests/assessment/statistics/groups/tables.h"
#include "tests/fixtures/cpu_time.h"

namespace seldinger::assessment::statistics {
namespace {

double pairs_above(const std::vector<double>& a, const std::vector<double>& b) {
  double u = 0.0;
  for (const double x : a)
    for (const double y : b) u += x > y ? 1.0 : x == y ? 0.5 : 0.0;
  return u;
}

// Both groups as one, dealt anew by the bits of `deal`; nothing where the sizes are others.
bool dealt(unsigned deal, const std::vector<double>& all, std::size_t n1, std::vector<double>& a,
           std::vector<double>& b) {
  a.clear();
  b.clear();
  for (std::size_t i = 0; i < all.size(); ++i) ((deal >> i & 1U) != 0 ? a : b).push_back(all[i]);
  return a.size() == n1;
}

TEST(Exact, MannWhitneyIsTheShareOfDealsAsFarOut) {
  RandomTables random(11);
  for (int set = 0; set < 30; ++set) {
    const std::vector<Group> groups = random.groups(2, 2, 6, set % 2 == 0, false);
    const std::vector<double>&a = groups[0].values, &b = groups[1].values;
    std::vector<double> all = a, first, second;
    all.insert(all.end(), b.begin(), b.end());
    const double middle = 0.5 * static_cast<double>(a.size() * b.size()), u = pairs_above(a, b);
    double deals = 0.0, as_far = 0.0, as_large = 0.0;
    for (unsigned deal = 0; deal < 1U << all.size(); ++deal) {
      if (!dealt(deal, all, a.size(), first, second)) continue;
      const double here = pairs_above(first, second);
      deals += 1.0;
      as_far += std::abs(here - middle) >= std::abs(u - middle) ? 1.0 : 0.0;
      as_large += here >= u ? 1.0 : 0.0;
    }
    const RankSumTest test = exact_rank_sum(a, b);
    EXPECT_EQ(test.u, u);
    expect_close(test.p_value, as_far / deals, 1e-12, "two-sided");
    expect_close(test.p_upper, as_large / deals, 1e-12, "one-sided");
  }
}

TEST(Exact, SignedRankIsTheShareOfSignsAsFarOut) {
  RandomTables random(12);
  for (int set = 0; set < 30; ++set) {
    const std::vector<double> d = random.values(random.from_to(3, 10), 0.5, 2.0, set % 2 == 0, false);
    // By pairs: V counts sums of two differences above 0, halves where they are 0; only without zeros.
    std::vector<double> sizes;
    for (const double one : d)
      if (one != 0.0) sizes.push_back(std::abs(one));
    const std::size_t n = sizes.size();
    const auto v_of = [&](const std::vector<double>& signed_sizes) {
      double v = 0.0;
      for (std::size_t i = 0; i < signed_sizes.size(); ++i)
        for (std::size_t j = i; j < signed_sizes.size(); ++j) {
          const double sum = signed_sizes[i] + signed_sizes[j];
          v += sum > 0.0 ? 1.0 : sum == 0.0 ? 0.5 : 0.0;
        }
      return v;
    };
    std::vector<double> kept;
    for (const double one : d)
      if (one != 0.0) kept.push_back(one);
    const double v = v_of(kept), middle = 0.25 * static_cast<double>(n * (n + 1));
    double as_far = 0.0;
    for (unsigned signs = 0; signs < 1U << n; ++signs) {
      std::vector<double> turned = sizes;
      for (std::size_t i = 0; i < n; ++i) turned[i] *= (signs >> i & 1U) != 0 ? 1.0 : -1.0;
      as_far += std::abs(v_of(turned) - middle) >= std::abs(v - middle) ? 1.0 : 0.0;
    }
    const SignedRankTest test = exact_signed_rank(d, false);
    EXPECT_EQ(test.v, v);
    expect_close(test.p_value, as_far / std::ldexp(1.0, static_cast<int>(n)), 1e-12, "two-sided");
  }
}

TEST(Exact, PermutationsGoThroughEveryDealOnce) {
  std::vector<std::vector<char>> seen;
  Exceedances deals({7, 3, 1000, 1});
  deals.go([&](const std::vector<char>& is_first) { seen.push_back(is_first); });
  EXPECT_TRUE(deals.all());
  EXPECT_EQ(seen.size(), 35u);
  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(std::unique(seen.begin(), seen.end()), seen.end());
  for (const std::vector<char>& one : seen) EXPECT_EQ(std::count(one.begin(), one.end(), 1), 3);
}

// Drawn deals: each as often as another, and the p-value near that of all of them.
TEST(Exact, DrawnPermutationsAgreeWithAll) {
  RandomTables random(13);
  const std::vector<Group> groups = random.groups(2, 7, 7, false, false);
  const std::vector<double>&a = groups[0].values, &b = groups[1].values;
  const PermutationTest all = studentised_permutation(a, b, 10'000, 1);
  const PermutationTest drawn = studentised_permutation(a, b, 3'000, 1),
                        again = studentised_permutation(a, b, 3'000, 1);
  EXPECT_TRUE(all.all);
  EXPECT_FALSE(drawn.all);
  EXPECT_EQ(drawn.p_value, again.p_value);
  EXPECT_NE(drawn.p_value, studentised_permutation(a, b, 3'000, 2).p_value);
  EXPECT_NEAR(drawn.p_value, all.p_value, 4.0 * std::sqrt(all.p_value * (1.0 - all.p_value) / 3'000.0) + 1e-3);
}

// T of every deal, by pairs: what the walk over the ordered values must come to.
TEST(Exact, BrunnerMunzelIsTheShareOfDealsAsFarOut) {
  RandomTables random(14);
  const auto size_of = [](const std::vector<double>& a, const std::vector<double>& b) {
    const auto above = [](double x, const std::vector<double>& others) {
      double count = 0.0;
      for (const double other : others) count += x > other ? 1.0 : x == other ? 0.5 : 0.0;
      return count;
    };
    const auto variance = [&](const std::vector<double>& of, const std::vector<double>& others) {
      std::vector<double> counts;
      for (const double x : of) counts.push_back(above(x, others));
      const double mean = std::accumulate(counts.begin(), counts.end(), 0.0) / static_cast<double>(counts.size());
      double sum = 0.0;
      for (const double count : counts) sum += (count - mean) * (count - mean);
      return sum / static_cast<double>(counts.size() - 1);
    };
    const double n1 = static_cast<double>(a.size()), n2 = static_cast<double>(b.size());
    const double off = std::abs(pairs_above(a, b) / (n1 * n2) - 0.5);
    const double error = std::sqrt(variance(a, b) / (n1 * n2 * n2) + variance(b, a) / (n2 * n1 * n1));
    return error > 1e-9 ? off / error : off > 0.0 ? 1e99 : 0.0;
  };
  for (int set = 0; set < 20; ++set) {
    const std::vector<Group> groups = random.groups(2, 3, 5, set % 2 == 0, false);
    const std::vector<double>&a = groups[0].values, &b = groups[1].values;
    std::vector<double> all = a, first, second;
    all.insert(all.end(), b.begin(), b.end());
    double deals = 0.0, as_far = 0.0;
    for (unsigned deal = 0; deal < 1U << all.size(); ++deal) {
      if (!dealt(deal, all, a.size(), first, second)) continue;
      deals += 1.0;
      as_far += size_of(first, second) >= size_of(a, b) * (1.0 - 1e-9) ? 1.0 : 0.0;
    }
    expect_close(studentised_permutation(a, b, 10'000, 1).p_value, as_far / deals, 1e-12, "permutation p");
  }
}

TEST(Exact, PairwiseValuesAreThoseOfAllPairsInOrder) {
  RandomTables random(15);
  for (int set = 0; set < 20; ++set) {
    std::vector<double> a = random.values(random.from_to(1, 9), 0.0, 3.0, set % 2 == 0, false);
    std::vector<double> b = random.values(random.from_to(1, 9), 1.0, 3.0, set % 2 == 0, false);
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    std::vector<double> differences, averages;
    for (const double x : a)
      for (const double y : b) differences.push_back(x - y);
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t j = i; j < a.size(); ++j) averages.push_back(0.5 * a[i] + 0.5 * a[j]);
    std::sort(differences.begin(), differences.end());
    std::sort(averages.begin(), averages.end());
    for (std::size_t k = 0; k < differences.size(); ++k) EXPECT_EQ(kth_difference(a, b, k + 1), differences[k]);
    for (std::size_t k = 0; k < averages.size(); ++k) EXPECT_EQ(kth_walsh_average(a, k + 1), averages[k]);
  }
}

// Two groups in an order are a Mann–Whitney test: J is U of the second, its variance that of U with ties.
TEST(Exact, JonckheereOfTwoGroupsIsMannWhitney) {
  RandomTables random(16);
  for (int set = 0; set < 20; ++set) {
    const std::vector<Group> groups = random.groups(2, 4, 12, set % 2 == 0, false);
    const Trend trend = jonckheere_trend(groups);
    const RankSumTest test = normal_rank_sum(groups[1].values, groups[0].values, false);
    EXPECT_EQ(trend.j, test.u);
    expect_close(0.5 * std::erfc(trend.z() / std::sqrt(2.0)), test.p_upper, 1e-9, "one-sided p");
  }
}

TEST(Exact, OneOutcomeOfMaxTIsNotAdjusted) {
  RandomTables random(17);
  const std::vector<double> outcome = random.values(12, 0.0, 1.0, false, false);
  const std::vector<char> is_first = {1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0};
  const MaxT one = max_t_test(std::vector<std::vector<double>>{outcome}, is_first, 10'000, 1);
  EXPECT_EQ(one.raw, one.adjusted);
  // The same outcome twice asks the same question: nothing is to be paid for it.
  const MaxT twice = max_t_test(std::vector<std::vector<double>>{outcome, outcome}, is_first, 10'000, 1);
  EXPECT_EQ(twice.adjusted[0], one.adjusted[0]);
}

TEST(Exact, OrderTurnsTheSignAndNothingElse) {
  RandomTables random(18);
  const DataTable table = table_of(random.groups(2, 8, 12, false, false));
  for (const auto run : {welch, student, mann_whitney}) {
    const Answer one = run(table, with({{"order", "a:b"}})), other = run(table, with({{"order", "b:a"}}));
    expect_close(one.estimate.value() + other.estimate.value(), 0.0, 1e-12, one.test);
    expect_close(one.ci95.value().low + other.ci95.value().high, 0.0, 1e-12, one.test);
    expect_close(one.p_value.value(), other.p_value.value(), 1e-12, one.test);
  }
}

TEST(Exact, NotSignificantSaysWhatWouldHaveBeenFound) {
  const DataTable table = table_of({{"a", {1, 2, 3, 4, 5}}, {"b", {1.5, 2.5, 3.5, 4.5, 6}}});
  for (const auto run : {welch, student, mann_whitney, brunner_munzel}) {
    const Answer answer = run(table, {});
    const bool said = std::any_of(answer.notes.begin(), answer.notes.end(),
                                  [](const std::string& note) { return note.rfind("Not significant", 0) == 0; });
    EXPECT_TRUE(said) << answer.test;
  }
}

TEST(Exact, FiftyAndFiftyTakeNoLongerThanATenthOfASecond) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "sanitizers take a time of their own";
#endif
  RandomTables random(19);
  for (const bool ties : {false, true}) {
    const DataTable table = table_of(
        {{"a", random.values(50, 5.0, 3.0, ties, false)}, {"b", random.values(50, 6.0, 3.0, ties, false)}});
    double least_s = 1e9;
    for (int i = 0; i < 5; ++i) {
      const double start_s = fixtures::cpu_s();
      EXPECT_NE(mann_whitney(table, {}).method.find("exact"), std::string::npos);
      least_s = std::min(least_s, fixtures::cpu_s() - start_s);
    }
    RecordProperty(ties ? "tied_ms" : "untied_ms", std::to_string(1e3 * least_s));
    EXPECT_LE(least_s, 0.1);
  }
}

}  // namespace
}  // namespace seldinger::assessment::statistics
