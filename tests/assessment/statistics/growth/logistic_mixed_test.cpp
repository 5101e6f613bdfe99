// The logistic mixed model: glmer on fresh data, the integral by brute force, what it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "assessment/statistics/growth/logistic_fit.h"
#include "assessment/statistics/growth/mixed_model.h"
#include "sim/base/rng.h"
#include "tests/assessment/statistics/growth/numbers_of.h"
#include "tests/assessment/statistics/growth/simulated_growth.h"
#include "tests/assessment/statistics/r_oracle.h"

namespace seldinger::assessment::statistics {
namespace {

using fixtures::number_of;

// Passes with log odds −1 + 0.3·x + a person's own (SD 1.2).
DataTable passes(base::Rng& rng, std::size_t persons, std::size_t attempts, std::size_t groups) {
  DataTable table = fixtures::unbalanced_growth(rng, persons, attempts, groups);
  std::vector<double> own;
  for (std::size_t i = 0; i < persons; ++i) own.push_back(1.2 * rng.normal());
  for (std::size_t i = 0; i < table.rows; ++i) {
    double& value = table.values.front().values[i];
    const auto person = std::stoul(table.subject[i].substr(1));
    const double p = 1.0 / (1.0 + std::exp(1.0 - 0.3 * table.x[i] - own[person]));
    if (!std::isnan(value)) value = rng.uniform() < p ? 1.0 : 0.0;
  }
  return table;
}

TEST(LogisticMixed, IsThatOfGlmer) {
  SELDINGER_NEEDS_R();
  std::ostringstream script;
  script << "suppressMessages(library(lme4))\n"
            "tight <- glmerControl(optimizer = 'bobyqa', optCtrl = list(rhoend = 1e-9, maxfun = 1e5))\n";
  std::vector<DataTable> tables;
  base::Rng rng(fixtures::r_seed() + 61);
  for (std::size_t i = 0; i < fixtures::r_sets(); ++i) {
    tables.push_back(passes(rng, 15 + rng.bits() % 20, 9, 1 + i % 2));
    script << fixtures::r_table(tables.back()) << "m <- suppressMessages(glmer(y ~ x" << (i % 2 == 1 ? " + g" : "")
           << " + (1 | s), d, binomial, nAGQ = 25, control = tight))\nc <- summary(m)$coefficients\n";
    for (const char* what : {"'b', c[2, 1]", "'se', c[2, 2]", "'a', c[1, 1]", "'z', c[2, 3]", "'ll', logLik(m)",
                             "'sd', as.data.frame(VarCorr(m))$sdcor[1]", "'last', c[nrow(c), 1]"}) {
      const std::string text = what;
      const std::size_t comma = text.find(',');
      script << "say(paste0(" << text.substr(0, comma) << ", " << i << ")" << text.substr(comma) << ")\n";
    }
  }
  const auto r = fixtures::r_values(script.str());
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const Answer answer = logistic_mixed(tables[i], {});
    ASSERT_TRUE(answer.estimable()) << answer.reason;
    const auto expect = [&](const char* name, double got, double share) {
      const double want = r.at(name + std::to_string(i));
      fixtures::note_difference(got, want);
      EXPECT_LE(std::abs(got - want), share * (std::abs(want) + 0.01))
          << name << i << ": " << got << " for " << want;
    };
    expect("ll", number_of(answer, "log_likelihood"), 1e-7);
    expect("a", number_of(answer, "intercept", "estimate"), 1e-4);
    expect("b", answer.estimate.value(), 1e-4);
    expect("last", answer.rows.back().values[0].value, 1e-4);
    expect("sd", number_of(answer, "sd_intercept"), 1e-3);
    expect("se", number_of(answer, "x", "se"), 1e-3);
    expect("z", answer.statistic.value(), 1e-3);
  }
}

// The likelihood at its own estimate, summed over a fine grid of intercepts.
TEST(LogisticMixed, LikelihoodIsTheIntegral) {
  base::Rng rng(5);
  LogisticRows rows;
  rows.fixed = 1;
  rows.persons = 12;
  for (std::size_t i = 0; i < 12; ++i)
    for (std::size_t k = 0; k < 6; ++k) {
      rows.y.push_back(rng.uniform() < (i % 3 == 0 ? 0.9 : 0.3) ? 1.0 : 0.0);
      rows.x.push_back(1.0);
      rows.person.push_back(i);
    }
  const LogisticOutcome outcome = fit_logistic(rows, 31);
  ASSERT_EQ(outcome.failure, LogisticFailure::none);
  ASSERT_GT(outcome.fit.sd, 0.3);
  double want = 0.0;
  for (std::size_t i = 0; i < 12; ++i) {
    double integral = 0.0;
    for (double z = -9.0; z <= 9.0; z += 0.001) {
      double product = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
      for (std::size_t k = 0; k < 6; ++k) {
        const double p = 1.0 / (1.0 + std::exp(-outcome.fit.beta[0] - outcome.fit.sd * z));
        product *= rows.y[i * 6 + k] == 1.0 ? p : 1.0 - p;
      }
      integral += 0.001 * product;
    }
    want += std::log(integral);
  }
  EXPECT_NEAR(outcome.fit.log_likelihood, want, 1e-9);
}

TEST(LogisticMixed, RefusesWhatHasNoEstimate) {
  base::Rng rng(6);
  const DataTable table = passes(rng, 12, 8, 1);
  DataTable all = table;
  for (double& one : all.values.front().values) one = 1.0;
  EXPECT_EQ(logistic_mixed(all, {}).reason, "no_variation");
  DataTable split = table;
  for (std::size_t i = 0; i < split.rows; ++i) split.values.front().values[i] = split.x[i] > 3.5 ? 1.0 : 0.0;
  EXPECT_EQ(logistic_mixed(split, {}).reason, "perfect_separation");
  DataTable other = table;
  other.values.front().values[0] = 2.0;
  EXPECT_EQ(logistic_mixed(other, {}).reason, "bad_value");
}

TEST(LogisticMixed, SaysThatPersonsDoNotDiffer) {
  DataTable table;
  table.values.push_back({"passed", {}});
  for (std::size_t person = 0; person < 10; ++person)
    for (std::size_t k = 0; k < 6; ++k) {
      table.values.front().values.push_back((k + person) % 2 == 0 ? 1.0 : 0.0);
      table.subject.push_back(std::to_string(person));
      ++table.rows;
    }
  const Answer answer = logistic_mixed(table, {});
  ASSERT_TRUE(answer.estimable());
  EXPECT_EQ(number_of(answer, "sd_intercept"), 0.0);
  EXPECT_NEAR(number_of(answer, "intercept", "se"), 2.0 / std::sqrt(60.0), 1e-6);
  EXPECT_THAT(answer.notes, testing::Contains(testing::HasSubstr("singular")));
}

}  // namespace
}  // namespace seldinger::assessment::statistics
