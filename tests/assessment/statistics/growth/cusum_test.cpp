// LC-CUSUM and CUSUM: published settings, enumeration of every sequence, and R's spc for normal values.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <sstream>

#include "assessment/statistics/growth/binary_cusum.h"
#include "assessment/statistics/growth/cusum_chart.h"
#include "assessment/statistics/growth/gauss.h"
#include "assessment/statistics/growth/normal_cusum.h"
#include "sim/base/rng.h"
#include "tests/assessment/statistics/growth/numbers_of.h"
#include "tests/assessment/statistics/r_oracle.h"

namespace seldinger::assessment::statistics {
namespace {

using fixtures::number_of;

CusumSteps competence(double adequate, double inadequate) {
  return {std::log((1.0 - adequate) / (1.0 - inadequate)), std::log(inadequate / adequate)};
}

DataTable outcomes(const std::string& letters) {
  DataTable table;
  table.rows = letters.size();
  table.values.push_back({"failure", {}});
  for (const char letter : letters) table.values.front().values.push_back(letter == 'F' ? 1.0 : 0.0);
  return table;
}

TEST(LcCusum, WalksThePublishedPath) {
  const Answer answer = lc_cusum(outcomes("FSFSSSFSSSSSSSSSSSSS"), CusumRule());
  ASSERT_TRUE(answer.estimable());
  const double w = 0.251314428281;
  const std::vector<double> want{0, w, 0, w, 2 * w, 3 * w, 0, w};
  ASSERT_EQ(answer.rows.size(), 20u);
  for (std::size_t i = 0; i < want.size(); ++i) EXPECT_NEAR(answer.rows[i].values[1].value, want[i], 1e-11) << i;
  EXPECT_NEAR(answer.statistic.value(), 3.267088, 1e-6);
  EXPECT_NEAR(number_of(answer, "weight_failure"), -1.098612288668, 1e-11);
  EXPECT_EQ(number_of(answer, "reached_at"), 0.0);
}

TEST(LcCusum, ErrorsOfALimitAreThoseOfTheFixture) {
  const CusumSteps steps = competence(0.10, 0.30);
  EXPECT_NEAR(reached_within(steps, 0.9, 1.25, 50), 0.999999, 5e-7);
  EXPECT_NEAR(reached_within(steps, 0.7, 1.25, 50), 0.973262, 5e-7);
  EXPECT_NEAR(reached_within(steps, 0.9, 2.5, 50), 0.992326, 5e-7);
  EXPECT_NEAR(reached_within(steps, 0.7, 2.5, 50), 0.371231, 5e-7);
}

TEST(LcCusum, LimitsAreThoseOfTheFixture) {
  struct Case {
    double adequate, inadequate;
    std::size_t attempts;
    double limit, true_declaration;
  };
  for (const Case& one : {Case{.10, .30, 50, 3.5184, .94628}, Case{.10, .20, 50, 2.4734, .64202},
                          Case{.05, .15, 50, 2.7806, .73650}, Case{.20, .40, 30, 2.7590, .76013}}) {
    const Answer answer = lc_cusum(outcomes("SSS"), {one.adequate, one.inadequate, one.attempts, 0.10});
    ASSERT_TRUE(answer.estimable());
    EXPECT_NEAR(answer.estimate.value(), one.limit, 5.1e-5);
    EXPECT_NEAR(number_of(answer, "true_declaration"), one.true_declaration, 5.1e-6);
    EXPECT_LE(number_of(answer, "false_declaration"), 0.10);
  }
}

// Every sequence of 14 attempts, walked and weighed.
TEST(BinaryCusum, ProbabilitiesAreThoseOfAllSequences) {
  constexpr std::size_t kAttempts = 14;
  for (const auto& [up, down, p, limit] : {std::array{0.2513, 1.0986, 0.7, 1.25},
                                           {0.7, 0.3, 0.2, 1.4},
                                           {1.0, 1.0, 0.45, 3.0},
                                           {0.5, 0.25, 0.4, 2.0}}) {
    const CusumSteps steps{up, down};
    std::vector<double> want(kAttempts);
    for (std::uint32_t bits = 0; bits < (1u << kAttempts); ++bits) {
      std::vector<bool> ups;
      double weight = 1.0;
      for (std::size_t t = 0; t < kAttempts; ++t) {
        ups.push_back(((bits >> t) & 1u) != 0);
        weight *= ups.back() ? p : 1.0 - p;
      }
      const auto path = cusum_path(steps, ups);
      const double least = limit - kSumSlack;
      const auto at = std::find_if(path.begin(), path.end(), [&](double sum) { return sum >= least; });
      if (at != path.end()) want[static_cast<std::size_t>(at - path.begin())] += weight;
    }
    const auto got = reaching(steps, p, limit, kAttempts);
    for (std::size_t t = 0; t < kAttempts; ++t) EXPECT_NEAR(got[t], want[t], 1e-13) << t;
  }
}

TEST(BinaryCusum, ALimitIsTheLeast) {
  for (const double permitted : {0.01, 0.05, 0.2}) {
    const CusumSteps steps = competence(0.05, 0.2);
    const double limit = limit_for(steps, 0.8, permitted, 60).value();
    EXPECT_LE(reached_within(steps, 0.8, limit, 60), permitted);
    EXPECT_GT(reached_within(steps, 0.8, limit - 1e-7, 60), permitted);
  }
  EXPECT_FALSE(limit_for(competence(0.1, 0.3), 0.7, 0.1, 6).has_value());  // 0.7⁶ = 0.118
}

// A chart without memory of its past but S runs on as the sum of the probabilities that it still runs.
TEST(BinaryCusum, RunLengthIsThatOfManyAttempts) {
  const CusumSteps steps{std::log(3.0), std::log(0.9 / 0.7)};
  const double length = run_length(steps, 0.3, 2.0);
  const auto reached = reaching(steps, 0.3, 2.0, 1500);
  double want = 0.0;
  for (std::size_t t = 0; t < reached.size(); ++t) want += static_cast<double>(t + 1) * reached[t];
  EXPECT_NEAR(std::accumulate(reached.begin(), reached.end(), 0.0), 1.0, 1e-12);
  EXPECT_NEAR(length, want, 1e-8 * want);
  // One failure suffices: 1/p attempts.
  EXPECT_NEAR(run_length(steps, 0.1, 1.0), 10.0, 1e-9);
}

TEST(LcCusum, TellsEachPersonAndWhoReachedTheLimit) {
  DataTable table = outcomes("SSSSSSSSSSSSSSSFFFFF");
  for (std::size_t i = 0; i < table.rows; ++i) table.subject.push_back(i < 15 ? "anna" : "ben");
  const Answer answer = lc_cusum(table, CusumRule());
  ASSERT_EQ(answer.rows.size(), 2u);
  EXPECT_EQ(answer.rows[0].name, "anna");
  EXPECT_EQ(answer.rows[0].values[3].value, 15.0);
  EXPECT_EQ(answer.rows[1].values[3].value, 0.0);
  EXPECT_EQ(number_of(answer, "persons_reached"), 1.0);
}

TEST(LcCusum, DeclaresNobodyAfterTheAttemptsOfItsError) {
  const Answer answer = lc_cusum(outcomes("FFFFFFFFFFSSSSSSSSSSSSSSSSSSSS"), {0.1, 0.3, 20, 0.1});
  ASSERT_TRUE(answer.estimable());
  EXPECT_EQ(number_of(answer, "reached_at"), 0.0);
  EXPECT_THAT(answer.notes, testing::Contains(testing::HasSubstr("after attempt 20")));
}

TEST(LcCusum, RefusesWhatIsNeitherSuccessNorFailure) {
  DataTable table = outcomes("SFS");
  table.values.front().values[1] = 0.5;
  EXPECT_EQ(lc_cusum(table, CusumRule()).reason, "bad_value");
  EXPECT_EQ(cusum(table, CusumRule()).reason, "bad_value");
  EXPECT_EQ(lc_cusum(outcomes(""), CusumRule()).reason, "no_data");
  EXPECT_EQ(lc_cusum(outcomes("S"), {0.3, 0.1, 50, 0.1}).reason, "bad_value");
  EXPECT_EQ(lc_cusum(outcomes("S"), {0.1, 0.3, 3, 0.1}).reason, "no_solution");
}

TEST(Cusum, FindsWhereFailuresBegin) {
  const Answer answer = cusum(outcomes("SSSSSFSSSSSSSSSFFFFFFF"), CusumRule{0.05, 0.25, 50, 0.05});
  ASSERT_TRUE(answer.estimable());
  EXPECT_LE(number_of(answer, "false_alarm"), 0.05);
  EXPECT_GT(number_of(answer, "true_alarm"), 0.8);
  const double at = number_of(answer, "reached_at");
  EXPECT_GT(at, 16.0);
  EXPECT_LT(at, 22.0);
  EXPECT_GT(number_of(answer, "run_length_adequate"), 10.0 * number_of(answer, "run_length_inadequate"));
}

TEST(Gauss, IntegratesPolynomials) {
  for (const std::size_t n : {3u, 15u, 40u}) {
    const Nodes legendre = gauss_legendre(n, -1.0, 3.0), hermite = gauss_hermite(n);
    double fifth = 0.0, fourth = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      fifth += legendre.weights[i] * std::pow(legendre.at[i], 5);
      fourth += hermite.weights[i] * std::pow(hermite.at[i], 4);
    }
    EXPECT_NEAR(fifth, 728.0 / 6.0, 1e-10);
    EXPECT_NEAR(fourth, 3.0, 1e-11);
  }
}

TEST(NormalCusum, RunLengthsAreThoseOfSpc) {
  EXPECT_NEAR(normal_run_length(0.5, 4.0, 0.0), 335.367577627, 1e-8);
  EXPECT_NEAR(0.5 * normal_run_length(0.5, 4.0, 0.0), 167.683788814, 1e-8);  // both sides, by symmetry
  EXPECT_NEAR(0.5 * normal_run_length(0.5, 5.0, 0.0), 465.443506032, 1e-8);
  SELDINGER_NEEDS_R();
  std::ostringstream script;
  script << "library(spc)\n";
  struct Case {
    double k, h, mean, length;
  };
  std::vector<Case> cases;
  base::Rng rng(fixtures::r_seed() + 31);
  for (std::size_t i = 0; i < fixtures::r_sets(); ++i) {
    cases.push_back(
        {0.1 + rng.uniform(), 0.5 + 4.0 * rng.uniform(), 2.0 * rng.uniform() - 0.5, 30 + 800 * rng.uniform()});
    const Case& c = cases.back();
    script.precision(17);
    script << "say('arl" << i << "', xcusum.arl(" << c.k << "," << c.h << "," << c.mean << ", r = 60))\n"
           << "say('h" << i << "', xcusum.crit(" << c.k << "," << c.length << ", r = 60))\n";
  }
  const auto r = fixtures::r_values(script.str());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const double arl = r.at("arl" + std::to_string(i)), h = r.at("h" + std::to_string(i));
    const double our_arl = normal_run_length(cases[i].k, cases[i].h, cases[i].mean);
    const double our_h = normal_limit(cases[i].k, cases[i].length);
    fixtures::note_difference(our_arl, arl);
    fixtures::note_difference(our_h, h);
    EXPECT_NEAR(our_arl, arl, 1e-6 * arl);
    EXPECT_NEAR(our_h, h, 1e-6 * h);
  }
}

TEST(NormalCusum, FindsAShiftOfValues) {
  DataTable table;
  table.values.push_back({"seconds", {}});
  for (int i = 0; i < 60; ++i)
    table.values.front().values.push_back(100.0 + (i < 30 ? 0.0 : 30.0) + (i % 3 - 1) * 12.0);
  table.rows = 60;
  const Answer later = cusum(table, NormalCusumRule{100.0, 15.0, 1.0, 500.0, false});
  ASSERT_TRUE(later.estimable());
  EXPECT_GT(number_of(later, "reached_at"), 30.0);
  EXPECT_NEAR(number_of(later, "run_length_at_target"), 500.0, 1e-6);
  EXPECT_EQ(number_of(cusum(table, NormalCusumRule{100.0, 15.0, 1.0, 500.0, true}), "reached_at"), 0.0);
}

}  // namespace
}  // namespace seldinger::assessment::statistics
