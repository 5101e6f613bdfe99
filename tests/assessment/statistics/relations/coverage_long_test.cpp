// Coverage of this shelf's intervals at n 12, 30 and 100, half in each group: issue "Validity statistics I".
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/relations/counts.h"
#include "assessment/statistics/relations/fisher_exact.h"
#include "assessment/statistics/relations/proportions.h"
#include "tests/assessment/statistics/relations/coverage.h"
#include "tests/assessment/statistics/relations/missing_values.h"

namespace seldinger::assessment::statistics {
namespace {

using fixtures::answer_of;
using fixtures::coverage_of;
using fixtures::Covered;
using fixtures::expect_published;
using fixtures::grouped;
using fixtures::Limits;
using fixtures::limits_or_lower;
using fixtures::named;
using fixtures::RandomTables;
using fixtures::related;

constexpr std::size_t kSizes[] = {12, 30, 100};

void expect_enumerated(const std::string& what, std::size_t n, const Covered& got, double enumerated) {
  const double error = 3.0 * std::sqrt(enumerated * (1.0 - enumerated) / static_cast<double>(got.runs));
  std::printf("            %-52s n %3zu  %.4f enumerated\n", what.c_str(), n, enumerated);
  EXPECT_NEAR(got.share(), enumerated, error + 1e-9) << what << ", n " << n;
}

TEST(Coverage, OfOneShareIsTheEnumerated) {
  for (const double p : {0.3, 0.5, 0.8, 0.95})
    for (const std::size_t n : kSizes) {
      const auto sample = [p](RandomTables& random, std::size_t size) {
        return answer_of("wilson", grouped({random.some(size, [&] { return random.one_or_zero(p); })}));
      };
      const auto whole = static_cast<std::int64_t>(n);
      expect_enumerated("Wilson, share " + std::to_string(p), n,
                        coverage_of("Wilson, share " + std::to_string(p), n, p, sample), wilson_coverage(whole, p));
      double exact = 0.0;
      for (std::int64_t k = 0; k <= whole; ++k) {
        const Interval interval = clopper_pearson_interval(k, whole);
        if (interval.low <= p && p <= interval.high) exact += binomial_pdf(k, whole, p);
      }
      EXPECT_GE(exact, 0.95);
      const Covered got =
          coverage_of("Clopper–Pearson, share " + std::to_string(p), n, p, sample,
                      [](const Answer& answer) -> std::optional<Limits> {
                        return Limits{named(answer, "clopper_pearson_low"), named(answer, "clopper_pearson_high")};
                      });
      expect_enumerated("Clopper–Pearson, share " + std::to_string(p), n, got, exact);
    }
}

TEST(Coverage, OfTwoSharesIsTheEnumerated) {
  const double p = 0.7, q = 0.4, odds = (p / (1.0 - p)) / (q / (1.0 - q));
  const auto sample = [&](RandomTables& random, std::size_t size) {
    return answer_of("fisher", grouped({random.some(size / 2, [&] { return random.one_or_zero(p); }),
                                        random.some(size / 2, [&] { return random.one_or_zero(q); })}));
  };
  for (const std::size_t n : kSizes) {
    const auto half = static_cast<std::int64_t>(n / 2);
    double exact = 0.0, hybrid = 0.0;
    for (std::int64_t k1 = 0; k1 <= half; ++k1)
      for (std::int64_t k2 = 0; k2 <= half; ++k2) {
        const double chance = binomial_pdf(k1, half, p) * binomial_pdf(k2, half, q);
        const FisherExact found = fisher_exact_of({k1, half, k2, half});
        const Interval difference = newcombe_interval(k1, half, k2, half);
        if (found.odds_low.value_or(0.0) <= odds && odds <= found.odds_high.value_or(INFINITY)) exact += chance;
        if (difference.low <= p - q && p - q <= difference.high) hybrid += chance;
      }
    EXPECT_GE(exact, 0.95);
    EXPECT_GE(hybrid, 0.93);
    // All alike: no interval, which holds everything.
    const auto odds_limits = [](const Answer& answer) -> std::optional<Limits> {
      if (answer.ci95) return Limits{answer.ci95->low, answer.ci95->high};
      const double low = named(answer, "odds_ratio_low");
      return Limits{std::isnan(low) ? -INFINITY : low, INFINITY};
    };
    expect_enumerated("odds ratio", n, coverage_of("odds ratio, exact", n, odds, sample, odds_limits), exact);
    const auto difference_limits = [](const Answer& answer) -> std::optional<Limits> {
      return Limits{named(answer, "risk_difference_low"), named(answer, "risk_difference_high")};
    };
    expect_enumerated("difference of shares", n,
                      coverage_of("difference of shares, Newcombe", n, p - q, sample, difference_limits), hybrid);
  }
}

TEST(Coverage, OfTwoRatesIsTheEnumerated) {
  const double rate = 1.0, other = 0.5;
  const auto sample = [&](RandomTables& random, std::size_t size) {
    return answer_of("poisson", grouped({random.some(size / 2, [&] { return random.poisson(rate); }),
                                         random.some(size / 2, [&] { return random.poisson(other); })}));
  };
  for (const std::size_t n : kSizes) {
    const double half = static_cast<double>(n) / 2.0;
    double exact = 0.0, none = poisson_pdf(0, half * rate) * poisson_pdf(0, half * other);
    for (std::int64_t k1 = 0; k1 < 200; ++k1)
      for (std::int64_t k2 = 0; k2 < 200; ++k2) {
        const double chance = poisson_pdf(k1, half * rate) * poisson_pdf(k2, half * other);
        if (k1 + k2 == 0 || chance < 1e-15) continue;
        const PoissonRatio found = poisson_ratio(k1, half, k2, half);
        if (found.low <= 2.0 && 2.0 <= found.high.value_or(INFINITY)) exact += chance;
      }
    exact /= 1.0 - none;
    EXPECT_GE(exact, 0.95);
    expect_enumerated("rate ratio", n,
                      coverage_of("rate ratio, exact", n, 2.0, sample, limits_or_lower("rate_ratio_low")), exact);
  }
}

TEST(Coverage, OfCorrelationsIsPublished) {
  for (const double rho : {0.0, 0.5, 0.8}) {
    const auto sample = [rho](const char* name) {
      return [rho, name](RandomTables& random, std::size_t size) {
        std::vector<double> x = random.some(size, [&] { return random.normal(); }), y;
        for (const double value : x) y.push_back(rho * value + std::sqrt(1.0 - rho * rho) * random.normal());
        return answer_of(name, related(y, x));
      };
    };
    const std::string normal = ", normal, correlation " + std::to_string(rho).substr(0, 3);
    expect_published("Pearson" + normal, rho, sample("pearson"));
    expect_published("Spearman" + normal, 6.0 / std::numbers::pi * std::asin(0.5 * rho), sample("spearman"));
    expect_published("Kendall" + normal, 2.0 / std::numbers::pi * std::asin(rho), sample("kendall"));
  }
}

// Skill of a positive is `shift` above; two values share it.
Answer areas_of(RandomTables& random, std::size_t size, double shift, double other, const char* name) {
  DataTable table = grouped({std::vector<double>(size / 2), std::vector<double>(size - size / 2)});
  table.values.push_back({"other", std::vector<double>(size)});
  for (std::size_t i = 0; i < size; ++i) {
    const double shared = random.normal();
    const double positive = i < size / 2 ? 0.0 : 1.0;
    table.values[0].values[i] = std::sqrt(0.5) * (shared + random.normal()) + positive * shift;
    table.values[1].values[i] = std::sqrt(0.5) * (shared + random.normal()) + positive * other;
  }
  return answer_of(name, table);
}

TEST(Coverage, OfAreasIsPublished) {
  const auto area = [](double shift) { return normal_cdf(shift / std::numbers::sqrt2); };
  for (const double shift : {0.0, 0.75, 1.8})
    expect_published(
        "AUC " + std::to_string(area(shift)).substr(0, 4) + ", normal", area(shift),
        [shift](RandomTables& random, std::size_t n) { return areas_of(random, n, shift, 0.0, "auc"); });
  expect_published("difference of AUCs .79 and .66, normal", area(1.14) - area(0.58),
                   [](RandomTables& random, std::size_t n) { return areas_of(random, n, 1.14, 0.58, "delong"); });
}

TEST(Coverage, OfRatesOfUnlikePersonsIsPublished) {
  expect_published("rate ratio, negative binomial, theta 1", 2.0, [](RandomTables& random, std::size_t n) {
    return answer_of("negative_binomial", grouped({random.some(n / 2, [&] { return random.overdispersed(6.0); }),
                                                   random.some(n / 2, [&] { return random.overdispersed(3.0); })}));
  });
}

std::pair<std::vector<double>, std::vector<double>> times_of(RandomTables& random, std::size_t n, double mean) {
  std::pair<std::vector<double>, std::vector<double>> times;
  for (std::size_t i = 0; i < n; ++i) {
    const double event = random.exponential(mean), gave_up = random.exponential(250.0);
    times.first.push_back(std::min(event, gave_up));
    times.second.push_back(event <= gave_up ? 1.0 : 0.0);
  }
  return times;
}

Answer two_times(RandomTables& random, std::size_t n, double mean, double other, const char* name,
                 std::map<std::string, std::string> options = {}) {
  const auto a = times_of(random, n / 2, mean), b = times_of(random, n / 2, other);
  std::vector<double> events = a.second;
  events.insert(events.end(), b.second.begin(), b.second.end());
  return answer_of(name, grouped({a.first, b.first}, events), std::move(options));
}

TEST(Coverage, OfTimesIsPublished) {
  const auto curve = [](RandomTables& random, std::size_t n) {
    const auto times = times_of(random, n, 100.0);
    return answer_of("kaplan_meier", grouped({times.first}, times.second));
  };
  expect_published("survival .5, exponential, 29 % censored", 0.5, curve,
                   [](const Answer& answer) -> std::optional<Limits> {
                     std::optional<Limits> at;
                     for (const Row& row : answer.rows)
                       if (row.values[0].value <= 100.0 * std::numbers::ln2)
                         at = Limits{row.values[5].value, row.values[6].value};
                     return at;
                   });
  expect_published("median time, exponential, 29 % censored", 100.0 * std::numbers::ln2, curve,
                   limits_or_lower("median_low"));
  expect_published("hazard ratio 1.5, Peto", 1.5, [](RandomTables& random, std::size_t n) {
    return two_times(random, n, 100.0, 150.0, "log_rank");
  });
  const auto mean_to = [](double mean, double tau) { return mean * (1.0 - std::exp(-tau / mean)); };
  expect_published("difference of mean times to 60", mean_to(50.0, 60.0) - mean_to(100.0, 60.0),
                   [](RandomTables& random, std::size_t n) {
                     return two_times(random, n, 50.0, 100.0, "rmst", {{"tau", "60"}});
                   });
}

TEST(Coverage, OfCensoredMeansIsPublished) {
  expect_published("difference of means, tobit, 31 % censored", -20.0, [](RandomTables& random, std::size_t n) {
    return answer_of("tobit",
                     grouped({random.some(n / 2, [&] { return 90.0 + 20.0 * random.normal(); }),
                              random.some(n / 2, [&] { return 110.0 + 20.0 * random.normal(); })}),
                     {{"limit", "110"}});
  });
}

TEST(Coverage, OfDrawsIsPublished) {
  const auto drawn = [](const char* statistic, bool two, bool skewed) {
    return [=](RandomTables& random, std::size_t n) {
      const auto one = [&] { return skewed ? random.exponential(1.0) : random.normal(); };
      std::vector<std::vector<double>> groups{random.some(two ? n / 2 : n, one)};
      if (two) groups.push_back(random.some(n / 2, one));
      return answer_of(
          "bootstrap", grouped(groups),
          {{"statistic", statistic}, {"resamples", "1000"}, {"seed", std::to_string(random.from_to(1, 1000000))}});
    };
  };
  constexpr std::size_t kRuns = 2000;
  expect_published("BCa, mean, normal", 0.0, drawn("mean", false, false), fixtures::limits_of, kRuns);
  expect_published("BCa, mean, exponential", 1.0, drawn("mean", false, true), fixtures::limits_of, kRuns);
  expect_published("BCa, median, normal", 0.0, drawn("median", false, false), fixtures::limits_of, kRuns);
  expect_published("BCa, median, exponential", std::numbers::ln2, drawn("median", false, true), fixtures::limits_of,
                   kRuns);
  expect_published("BCa, difference of means, exponential", 0.0, drawn("mean", true, true), fixtures::limits_of,
                   kRuns);
  expect_published("BCa, difference of medians, normal", 0.0, drawn("median", true, false), fixtures::limits_of,
                   kRuns);
}

// Where who is missing depends on what is known: with it the interval holds the truth, without it it does not.
TEST(Coverage, OfImputedMeansIsAsPromised) {
  for (const std::size_t each : {12u, 30u, 100u}) {
    base::Rng rng(110 + each);
    const fixtures::Imputed found = fixtures::imputed_coverage(rng, each, 2000);
    std::printf("imputed, %zu in each group: %.4f, without x %.4f, bias %.4f, %zu runs\n", each, found.covered,
                found.covered_by_present, found.bias, found.runs);
    EXPECT_GE(found.runs, 1900u);
    EXPECT_GE(found.covered, 0.93);
    EXPECT_LE(found.covered, each < 30 ? 0.98 : 0.97);  // of few, wider than it need be
    EXPECT_LT(std::abs(found.bias), 0.03);
  }
}

}  // namespace
}  // namespace seldinger::assessment::statistics
