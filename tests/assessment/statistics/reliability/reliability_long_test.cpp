// Coverage of the shelf's intervals, and its rows with ten thousand odd tables each.
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/reliability/alpha.h"
#include "assessment/statistics/reliability/bland_altman.h"
#include "assessment/statistics/reliability/g_theory.h"
#include "assessment/statistics/reliability/icc.h"
#include "assessment/statistics/reliability/kappa.h"
#include "assessment/statistics/reliability/omega.h"
#include "tests/assessment/statistics/covered.h"
#include "tests/assessment/statistics/reliability/odd_reliability.h"
#include "tests/assessment/statistics/reliability/score_tables.h"

namespace seldinger::assessment::statistics {
namespace {

using fixtures::Coverage;
using fixtures::number_of;

constexpr std::size_t kRuns = 20000, kBootstrapRuns = 2000;
constexpr std::size_t kSizes[] = {12, 30, 100};

bool warns(const Answer& answer, const char* word) {
  for (const std::string& note : answer.notes)
    if (note.find(word) != std::string::npos) return true;
  return false;
}

std::string with_n(const char* what, std::size_t n) {
  return std::string(what) + ", n = " + std::to_string(n);
}

TEST(ReliabilityLong, OddTables) {
  fixtures::expect_sound_reliability(10000);
}

// Subjects' variance 1, error's .5: ICC .667 where raters do not differ. A rater's leniency is drawn anew each
// time.
TEST(ReliabilityLong, IccCovers) {
  for (const std::size_t n : kSizes) {
    Coverage one_way, consistency, consistency_mean, agreement;
    for (std::size_t run = 0; run < kRuns; ++run) {
      const auto same =
          iccs(two_way(fixtures::scores(fixtures::random_scores(run, n, 3, 1.0, 0.0, std::sqrt(0.5), false))));
      one_way.add(same[0].ci95, 1.0 / 1.5);
      const auto lenient = iccs(
          two_way(fixtures::scores(fixtures::random_scores(kRuns + run, n, 3, 1.0, 0.5, std::sqrt(0.5), false))));
      consistency.add(lenient[2].ci95, 1.0 / 1.5);
      consistency_mean.add(lenient[5].ci95, 1.0 / (1.0 + 0.5 / 3.0));
      agreement.add(lenient[1].ci95, 1.0 / 1.75);
    }
    one_way.expect_exact(with_n("ICC(1)", n));
    consistency.expect_exact(with_n("ICC(3,1)", n));
    consistency_mean.expect_exact(with_n("ICC(3,k)", n));
    const Answer of_three = icc(fixtures::scores(fixtures::random_scores(1, n, 3, 1.0, 0.5, 0.7, false)), 1);
    agreement.expect_near_or_warned(with_n("ICC(2,1) by F", n), warns(of_three, "too narrow"));
  }
}

TEST(ReliabilityLong, AlphaCovers) {
  for (const std::size_t n : kSizes) {
    Coverage normal, likert;
    for (std::size_t run = 0; run < kRuns; ++run) {
      normal.add(alpha(fixtures::scores(fixtures::random_scores(run, n, 5, 1.0, 0.3, 1.0, false)), {}).ci95,
                 5.0 / 6.0);
      // Whole numbers: rounding adds a twelfth to the error.
      likert.add(alpha(fixtures::scores(fixtures::random_scores(run, n, 5, 1.0, 0.3, 1.0, true)), {}).ci95,
                 5.0 / (5.0 + 1.0 + 1.0 / 12.0));
    }
    normal.expect_exact(with_n("alpha (Feldt)", n));
    likert.expect_near_or_warned(with_n("alpha of whole numbers", n), false);
  }
}

TEST(ReliabilityLong, BlandAltmanCovers) {
  for (const std::size_t n : kSizes) {
    Coverage bias, limit;
    for (std::size_t run = 0; run < kRuns; ++run) {
      base::Rng rng(run);
      fixtures::Rows rows;
      for (std::size_t i = 0; i < n; ++i) {
        const double truth = rng.normal();
        rows.push_back({truth + 0.3 + 0.4 * rng.normal(), truth + 0.3 * rng.normal()});
      }
      const Answer answer = bland_altman(fixtures::scores(rows), 1.96);
      bias.add(answer.ci95, 0.3);
      limit.add(Interval{number_of(answer, "limit_high_ci95_low"), number_of(answer, "limit_high_ci95_high")},
                0.3 + 1.96 * 0.5);
    }
    bias.expect_exact(with_n("Bland-Altman, bias", n));
    limit.expect_near_or_warned(with_n("Bland-Altman, a limit", n), false);
  }
}

// Two raters of three categories: both see the truth in 80 of 100, else any category.
TEST(ReliabilityLong, KappaCovers) {
  const double shares[] = {0.5, 0.3, 0.2};
  const auto category = [&](double u) { return u < shares[0] ? 1.0 : u < shares[0] + shares[1] ? 2.0 : 3.0; };
  // Agreement beyond chance is there where both see it: .8².
  for (const std::size_t n : kSizes) {
    Coverage coverage;
    bool warned = true;
    for (std::size_t run = 0; run < kRuns; ++run) {
      base::Rng rng(run);
      fixtures::Rows rows;
      for (std::size_t i = 0; i < n; ++i) {
        const double truth = category(rng.uniform());
        const auto seen = [&] {
          const bool sees = rng.uniform() < 0.8;
          const double any = category(rng.uniform());
          return sees ? truth : any;
        };
        const double a = seen(), b = seen();
        rows.push_back({a, b});
      }
      const Answer answer = kappa(fixtures::scores(rows), KappaWeights::kNone);
      if (!answer.estimable()) continue;
      coverage.add(answer.ci95, 0.64);
      warned = warned && (!answer.ci95 || warns(answer, "interval"));
    }
    coverage.expect_near_or_warned(with_n("kappa", n), warned);
  }
}

// Two and three raters who differ: where the F interval fails.
TEST(ReliabilityLong, PivotalAgreementCovers) {
  for (const std::size_t n : kSizes)
    for (const std::size_t k : {2, 3}) {
      Coverage coverage;
      for (std::size_t run = 0; run < kBootstrapRuns; ++run)
        coverage.add(
            pivotal_agreement_interval(
                two_way(fixtures::scores(fixtures::random_scores(run, n, k, 1.0, 0.5, 0.3, false))), false),
            1.0 / 1.34);
      coverage.expect_near_or_warned(
          with_n(k == 2 ? "pivotal ICC(2,1), two raters" : "pivotal ICC(2,1), three raters", n), false);
    }
}

TEST(ReliabilityLong, PhiCovers) {
  for (const std::size_t n : kSizes) {
    Coverage coverage;
    for (std::size_t run = 0; run < kBootstrapRuns; ++run)
      coverage.add(
          g_theory(fixtures::long_table(fixtures::random_scores(run, n, 5, 1.0, 0.5, 1.0, false)), 0.8).ci95,
          1.0 / (1.0 + 1.25 / 5.0));
    coverage.expect_near_or_warned(with_n("Phi of five cases", n), false);
  }
}

TEST(ReliabilityLong, OmegaCovers) {
  for (const std::size_t n : kSizes) {
    Coverage coverage;
    bool warned = true;
    for (std::size_t run = 0; run < kBootstrapRuns; ++run) {
      const Answer answer =
          omega(fixtures::scores(fixtures::random_scores(run, n, 5, 1.0, 0.0, 1.0, false)), {}, 100, run);
      if (!answer.estimable()) continue;
      coverage.add(answer.ci95, 5.0 / 6.0);
      warned = warned && (!answer.ci95 || warns(answer, "interval"));
    }
    coverage.expect_near_or_warned(with_n("omega", n), warned);
  }
}

}  // namespace
}  // namespace seldinger::assessment::statistics
