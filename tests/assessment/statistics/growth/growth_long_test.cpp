// What takes many simulated learners: error rates of charts, coverage and size of models.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "assessment/statistics/growth/binary_cusum.h"
#include "assessment/statistics/growth/mixed_model.h"
#include "assessment/statistics/growth/normal_cusum.h"
#include "assessment/statistics/growth/rasch/rasch.h"
#include "sim/base/rng.h"
#include "tests/assessment/statistics/growth/numbers_of.h"
#include "tests/assessment/statistics/growth/odd_growth.h"
#include "tests/assessment/statistics/growth/simulated_growth.h"

namespace seldinger::assessment::statistics {
namespace {

using fixtures::number_of;

constexpr int kLearners = 100'000;

TEST(GrowthProceduresLong, AnswerOddTablesWithNumbersOrAReason) {
  fixtures::expect_sound_growth(10'000);
}

// The attempt at which a simulated sum reaches the limit; 0: not within `attempts`.
std::size_t reached_at(base::Rng& rng, const CusumSteps& steps, double p_up, double limit, std::size_t attempts) {
  double sum = 0.0;
  for (std::size_t t = 1; t <= attempts; ++t) {
    sum = std::max(0.0, sum + (rng.uniform() < p_up ? steps.up : -steps.down));
    if (sum >= limit - kSumSlack) return t;
  }
  return 0;
}

void expect_share(base::Rng& rng, const CusumSteps& steps, double p_up, double limit, std::size_t attempts,
                  const char* what) {
  const double want = reached_within(steps, p_up, limit, attempts);
  int reached = 0;
  for (int i = 0; i < kLearners; ++i) reached += reached_at(rng, steps, p_up, limit, attempts) > 0 ? 1 : 0;
  const double got = static_cast<double>(reached) / kLearners, se = std::sqrt(want * (1.0 - want) / kLearners);
  std::printf("%s: exact %.6f, of %d simulated %.6f, off by %.2f SE\n", what, want, kLearners, got,
              (got - want) / se);
  EXPECT_LE(std::abs(got - want), 3.0 * se) << what;
}

TEST(CusumLong, ErrorsAreThoseOfSimulatedLearners) {
  base::Rng rng(101);
  struct Case {
    double adequate, inadequate, permitted;
    std::size_t attempts;
  };
  for (const Case& one : {Case{.10, .30, .10, 50}, Case{.10, .20, .10, 50}, Case{.05, .15, .10, 50},
                          Case{.20, .40, .10, 30}, Case{.10, .30, .05, 100}}) {
    const double success = std::log((1.0 - one.adequate) / (1.0 - one.inadequate));
    const double failure = std::log(one.inadequate / one.adequate);
    const CusumSteps learning{success, failure}, monitoring{failure, success};
    const double h = limit_for(learning, 1.0 - one.inadequate, one.permitted, one.attempts).value();
    expect_share(rng, learning, 1.0 - one.inadequate, h, one.attempts, "LC-CUSUM, false declaration");
    expect_share(rng, learning, 1.0 - one.adequate, h, one.attempts, "LC-CUSUM, true declaration");
    const double alarm = limit_for(monitoring, one.adequate, one.permitted, one.attempts).value();
    expect_share(rng, monitoring, one.adequate, alarm, one.attempts, "CUSUM, false alarm");
    expect_share(rng, monitoring, one.inadequate, alarm, one.attempts, "CUSUM, true alarm");
  }
}

template <typename Draw>
void expect_length(const char* what, double want, const Draw& draw) {
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < kLearners; ++i) {
    const double length = draw();
    sum += length / kLearners;
    squares += length * length / kLearners;
  }
  const double se = std::sqrt((squares - sum * sum) / kLearners);
  std::printf("%s: exact %.4f, of %d simulated %.4f, off by %.2f SE\n", what, want, kLearners, sum,
              (sum - want) / se);
  EXPECT_LE(std::abs(sum - want), 3.0 * se) << what;
}

TEST(CusumLong, RunLengthsAreThoseOfSimulatedCharts) {
  base::Rng rng(102);
  const CusumSteps steps{std::log(3.0), std::log(0.9 / 0.7)};
  for (const double p : {0.1, 0.3})
    expect_length("CUSUM of failures, run length", run_length(steps, p, 2.2),
                  [&] { return static_cast<double>(reached_at(rng, steps, p, 2.2, 100'000)); });
  expect_length("CUSUM of values, run length", normal_run_length(0.5, 3.0, 0.0), [&] {
    double sum = 0.0, t = 0.0;
    for (; sum < 3.0; ++t) sum = std::max(0.0, sum + rng.normal() - 0.5);
    return t;
  });
}

struct Coverage {
  int covered = 0, significant = 0, warned = 0, runs = 0;
  void add(const Answer& answer, double truth) {
    ++runs;
    covered += answer.ci95->low <= truth && truth <= answer.ci95->high ? 1 : 0;
    significant += *answer.p_value < 0.05 ? 1 : 0;
    warned += answer.notes.empty() ? 0 : 1;
  }
  double share() const { return static_cast<double>(covered) / runs; }
  void tell(const char* what, std::size_t persons) const {
    std::printf("%s, %zu persons: coverage %.4f, size %.4f, with a note %.4f, %d runs\n", what, persons, share(),
                static_cast<double>(significant) / runs, static_cast<double>(warned) / runs, runs);
  }
};

// No slope on average, so that what is significant is an error.
TEST(MixedModelLong, SlopeIsCoveredAndItsSizeHolds) {
  for (const bool slopes : {true, false})
    for (const std::size_t persons : {12u, 30u, 100u}) {
      base::Rng rng(103 + persons);
      Coverage coverage;
      for (int run = 0; run < 2000; ++run) {
        const DataTable table =
            fixtures::unbalanced_growth(rng, persons, slopes ? 9 : 3, 1, 0.0, slopes ? 1.0 : 0.0);
        const Answer answer = mixed_model(table, {});
        ASSERT_TRUE(answer.estimable());
        coverage.add(answer, 0.0);
      }
      coverage.tell(slopes ? "mixed model, random slopes" : "mixed model, random intercepts", persons);
      EXPECT_GE(coverage.share(), 0.93);
      EXPECT_LE(coverage.share(), 0.97);
    }
}

TEST(LogisticMixedLong, SlopeIsCovered) {
  for (const std::size_t persons : {12u, 30u, 100u}) {
    base::Rng rng(104 + persons);
    Coverage coverage;
    for (int run = 0; run < 1000; ++run) {
      DataTable table = fixtures::unbalanced_growth(rng, persons, 9, 1);
      std::vector<double> own;
      for (std::size_t i = 0; i < persons; ++i) own.push_back(rng.normal());
      for (std::size_t i = 0; i < table.rows; ++i)
        table.values.front().values[i] =
            rng.uniform() < 1.0 / (1.0 + std::exp(-own[std::stoul(table.subject[i].substr(1))])) ? 1.0 : 0.0;
      const Answer answer = logistic_mixed(table, {});
      if (answer.estimable()) coverage.add(answer, 0.0);
    }
    coverage.tell("logistic mixed model", persons);
    EXPECT_GE(coverage.runs, 990);
    EXPECT_GE(coverage.share(), 0.93);
    EXPECT_LE(coverage.share(), 0.975);
  }
}

TEST(RaschLong, DifficultiesAreCovered) {
  for (const std::size_t persons : {30u, 100u}) {
    base::Rng rng(105 + persons);
    int covered = 0, runs = 0, refused = 0;
    for (int run = 0; run < 1000; ++run) {
      DataTable table;
      const double difficulties[] = {-1.0, -0.5, 0.0, 0.5, 1.0};
      for (const double one : difficulties) table.values.push_back({std::to_string(one), {}});
      for (std::size_t p = 0; p < persons; ++p, ++table.rows) {
        const double ability = rng.normal();
        for (std::size_t i = 0; i < 5; ++i)
          table.values[i].values.push_back(rng.uniform() < 1.0 / (1.0 + std::exp(difficulties[i] - ability)) ? 1
                                                                                                             : 0);
      }
      const Answer answer = rasch(table);
      if (!answer.estimable() || number_of(answer, "items") < 5.0) {
        ++refused;
        continue;
      }
      for (std::size_t i = 0; i < 5; ++i, ++runs) {
        const double off = answer.rows[i].values[0].value - difficulties[i];
        covered += std::abs(off) <= 1.96 * answer.rows[i].values[1].value ? 1 : 0;
      }
    }
    const double share = static_cast<double>(covered) / runs;
    std::printf("Rasch, %zu persons: difficulties covered %.4f, %d runs refused\n", persons, share, refused);
    EXPECT_GE(share, 0.93);
    EXPECT_LE(share, 0.975);
  }
}

}  // namespace
}  // namespace seldinger::assessment::statistics
