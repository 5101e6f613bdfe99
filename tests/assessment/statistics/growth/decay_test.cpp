// Skill decay: R on fresh data, a planted loss within its interval, and tables that have none.
#include "assessment/statistics/growth/decay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "sim/base/rng.h"
#include "tests/assessment/statistics/growth/numbers_of.h"
#include "tests/assessment/statistics/r_oracle.h"

namespace seldinger::assessment::statistics {
namespace {

using fixtures::number_of;

struct Visits {
  DataTable table;
  void add(const std::string& person, double day, double value) {
    if (table.values.empty()) table.values.push_back({"score", {}});
    table.values.front().values.push_back(value);
    table.subject.push_back(person);
    table.x.push_back(day);
    ++table.rows;
  }
};

// Persons who lose `per_doubling` of a score with each doubling of a pause.
Visits planted(std::uint64_t seed, std::size_t persons, double loss, double per_doubling) {
  base::Rng rng(seed);
  Visits visits;
  for (std::size_t p = 0; p < persons; ++p) {
    double day = 0.0, skill = 70.0 + 5.0 * rng.normal();
    for (int visit = 0; visit < 4; ++visit) {
      for (int i = 0; i < 3; ++i) visits.add("p" + std::to_string(p), day + 0.01 * i, skill + rng.normal());
      const double pause = 7.0 * (1 << static_cast<int>(3.0 * rng.uniform()));  // 7, 14 or 28 days
      day += pause;
      skill -= loss + per_doubling * std::log2(pause / 14.0);
    }
  }
  return visits;
}

TEST(Decay, IsRsTestOfPersonsMeans) {
  SELDINGER_NEEDS_R();
  std::ostringstream script;
  std::vector<Answer> answers;
  for (std::size_t i = 0; i < fixtures::r_sets(); ++i) {
    const Visits visits = planted(fixtures::r_seed() + i, 4 + i % 5, 3.0, 1.0);
    answers.push_back(decay(visits.table, {.higher_is_better = true}));
    script << "p <- c(";
    for (std::size_t k = 0; k < visits.table.rows; ++k)
      script << (k > 0 ? "," : "") << '"' << visits.table.subject[k] << '"';
    script << "); x <- " << fixtures::r_vector(visits.table.x) << "; y <- "
           << fixtures::r_vector(visits.table.values.front().values) << R"(
n <- length(y); same <- c(FALSE, p[-1] == p[-n]); gap <- c(NA, diff(x)); loss <- c(NA, -diff(y))
at <- which(same & gap >= 1)
d <- data.frame(p = p[at], g = log2(gap[at]), loss = loss[at])
t <- t.test(tapply(d$loss, d$p, mean))
)"
           << "say(\"e" << i << "\", t$estimate); say(\"l" << i << "\", t$conf.int[1]); say(\"h" << i
           << "\", t$conf.int[2]); say(\"s" << i << "\", coef(lm(loss ~ g + factor(p), d))[2])\n";
  }
  auto said = fixtures::r_values(script.str());
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const std::string k = std::to_string(i);
    fixtures::note_difference(answers[i].estimate.value(), said["e" + k]);
    fixtures::note_difference(answers[i].ci95->low, said["l" + k]);
    EXPECT_NEAR(answers[i].estimate.value(), said["e" + k], 1e-9);
    EXPECT_NEAR(answers[i].ci95->low, said["l" + k], 1e-9);
    EXPECT_NEAR(answers[i].ci95->high, said["h" + k], 1e-9);
    EXPECT_NEAR(number_of(answers[i], "loss_per_doubling"), said["s" + k], 1e-8);
  }
}

TEST(Decay, FindsThePlantedLossWithinItsInterval) {
  constexpr int kSets = 400;
  int covered = 0;
  double slopes = 0.0;
  for (std::uint64_t seed = 0; seed < kSets; ++seed) {
    const Answer answer = decay(planted(seed, 12, 3.0, 1.0).table, {.higher_is_better = true});
    covered += answer.ci95->low <= 3.0 && 3.0 <= answer.ci95->high ? 1 : 0;
    slopes += number_of(answer, "loss_per_doubling") / kSets;
  }
  EXPECT_NEAR(covered / static_cast<double>(kSets), 0.95, 3.0 * std::sqrt(0.95 * 0.05 / kSets) + 0.005);
  EXPECT_NEAR(slopes, 1.0, 0.1);
}

TEST(Decay, CountsALossAsPositiveOnEitherSide) {
  const Visits visits = planted(1, 6, 3.0, 0.0);
  EXPECT_DOUBLE_EQ(decay(visits.table, {.higher_is_better = true}).estimate.value(),
                   -decay(visits.table, {.higher_is_better = false}).estimate.value());
}

TEST(Decay, IsRefusedWithAReason) {
  EXPECT_EQ(decay(planted(1, 2, 3.0, 1.0).table, {}).reason, "too_few");
  EXPECT_EQ(decay(planted(1, 6, 3.0, 1.0).table, {.pause = 100.0}).reason, "too_few") << "nobody pauses so long";
  EXPECT_EQ(decay(planted(1, 6, 3.0, 1.0).table, {.pause = 0.0}).reason, "bad_value");
  DataTable nothing;
  nothing.values.push_back({"score", {}});
  EXPECT_EQ(decay(nothing, {}).reason, "no_data");
}

}  // namespace
}  // namespace seldinger::assessment::statistics
