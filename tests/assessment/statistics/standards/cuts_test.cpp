// Borderline, Angoff, Hofstee and the consistency of decisions, against R and what can be worked out by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "assessment/statistics/standards/angoff.h"
#include "assessment/statistics/standards/borderline.h"
#include "assessment/statistics/standards/classification.h"
#include "assessment/statistics/standards/hofstee.h"
#include "assessment/statistics/standards/standards_procedures.h"
#include "sim/base/rng.h"
#include "tests/assessment/statistics/r_oracle.h"

namespace seldinger::assessment::statistics {
namespace {

void expect_standard(double got, double want, double tolerance = 1e-9) {
  fixtures::note_difference(got, want);
  EXPECT_LE(std::abs(got - want), tolerance * std::max(1.0, std::abs(want))) << got << " for " << want;
}

double in_answer(const Answer& answer, const std::string& name) {
  for (const Named& one : answer.more)
    if (one.name == name) return one.value;
  return std::nan("");
}

Answer run_standard(const std::string& name, const DataTable& table, std::map<std::string, std::string> options) {
  for (const Procedure& one : standards_procedures())
    if (one.name == name) return one.run(table, ProcedureOptions(std::move(options)));
  ADD_FAILURE() << name;
  return {};
}

DataTable score_table(std::vector<double> scores) {
  DataTable table;
  table.rows = scores.size();
  table.values.push_back({"score", std::move(scores)});
  return table;
}

TEST(Borderline, IsWhereTheLineSaysAndWhatTheGroupScores) {
  // Scores 10 a rating, and 5 more at the borderline.
  const RatedScores rated{{10, 10, 25, 25, 25, 25, 25, 30, 30}, {1, 1, 2, 2, 2, 2, 2, 3, 3}, 0, 2.0};
  const Answer group = borderline(rated, BorderlineMethod::kGroup, 200, 1);
  EXPECT_EQ(*group.estimate, 25.0);
  const Answer line = borderline(rated, BorderlineMethod::kRegression, 200, 1);
  expect_standard(*line.estimate, 205.0 / 9.0, 1e-12);
  expect_standard(in_answer(line, "slope"), 10.0, 1e-12);
  ASSERT_EQ(line.rows.size(), 2u);
  ASSERT_TRUE(line.ci95);
  EXPECT_LT(line.ci95->low, *line.estimate);
  EXPECT_GT(line.ci95->high, *line.estimate);
}

TEST(Borderline, RefusesWithAReason) {
  EXPECT_EQ(borderline({{1, 2, 3, 4}, {1, 2, 3, 4}, 0, 2}, BorderlineMethod::kRegression, 0, 1).reason, "too_few");
  EXPECT_EQ(borderline({{1, 2, 3, 4, 5}, {2, 2, 2, 2, 2}, 0, 2}, BorderlineMethod::kRegression, 0, 1).reason,
            "no_variation");
  EXPECT_EQ(borderline({{1, 2, 3, 4, 5}, {1, 2, 2, 2, 2}, 0, 2}, BorderlineMethod::kGroup, 0, 1).reason,
            "group_too_small");
  DataTable twice = score_table({1, 2, 3, 4, 5, 6});
  twice.x = {1, 2, 3, 1, 2, 3};
  twice.subject = {"a", "b", "c", "d", "e", "a"};
  EXPECT_EQ(run_standard("borderline", twice, {}).reason, "repeated_subject");
  EXPECT_EQ(run_standard("borderline", twice, {{"method", "both"}}).reason, "bad_value");
}

TEST(Angoff, IsTheMeanOverJudgesOfTheirShares) {
  DataTable table;
  table.values.push_back({"share", {}});
  const double shares[2][3][4] = {{{.5, .6, .7, .9}, {.4, .5, .6, .8}, {.9, .9, .8, .9}},
                                  {{.6, .6, .7, .8}, {.5, .6, .6, .8}, {.7, .8, .8, .8}}};
  for (int round = 0; round < 2; ++round)
    for (int judge = 0; judge < 3; ++judge)
      for (int item = 0; item < 4; ++item) {
        table.values.front().values.push_back(100.0 * shares[round][judge][item]);
        table.subject.push_back("i" + std::to_string(item));
        table.rater.push_back("j" + std::to_string(judge));
        table.x.push_back(round + 1);
      }
  table.rows = table.x.size();
  const Answer answer = run_standard("angoff", table, {{"scale", "100"}});
  ASSERT_TRUE(answer.estimable()) << answer.reason;
  // Judges .675, .625 and .775: mean .691667, SD .0763763; t(.975, 2) 4.302652730.
  expect_standard(*answer.estimate, 8.3 / 12.0, 1e-12);
  expect_standard(in_answer(answer, "se"), std::sqrt(0.005833333333333333 / 3.0), 1e-12);
  expect_standard(answer.ci95->high - *answer.estimate, 4.302652729911275 * std::sqrt(0.005833333333333333 / 3.0),
                  1e-9);
  expect_standard(in_answer(answer, "cut_items"), 8.3 / 3.0, 1e-12);
  ASSERT_EQ(answer.rows.size(), 2u);
  expect_standard(answer.rows[0].values[2].value, 8.5 / 12.0, 1e-12);
  EXPECT_EQ(answer.n, 3u);
  EXPECT_FALSE(answer.notes.empty());  // three judges are few
  EXPECT_EQ(run_standard("angoff", table, {}).reason, "bad_value");
}

TEST(Angoff, RefusesOneJudge) {
  DataTable table = score_table({.4, .5});
  table.subject = {"a", "b"};
  table.rater = {"j", "j"};
  EXPECT_EQ(run_standard("angoff", table, {}).reason, "too_few");
}

// Where the share of scores below a cut meets the line, among a fine grid of cuts.
double by_search(const std::vector<double>& scores, const HofsteeCorners& corners) {
  const int steps = 400000;
  for (int i = 0; i <= steps; ++i) {
    const double cut = corners.cut_low + (corners.cut_high - corners.cut_low) * i / steps;
    const double line = corners.fail_high - (corners.fail_high - corners.fail_low) * i / steps;
    const auto at_or_below = std::count_if(scores.begin(), scores.end(), [&](double one) { return one <= cut; });
    if (static_cast<double>(at_or_below) / static_cast<double>(scores.size()) >= line) return cut;
  }
  return std::nan("");
}

TEST(Hofstee, IsWhatASearchOverAllCutsFinds) {
  base::Rng rng(11);
  int found = 0;
  for (int run = 0; run < 30; ++run) {
    std::vector<double> scores(5 + run);
    for (double& score : scores) score = std::round(20.0 * rng.uniform());
    std::sort(scores.begin(), scores.end());
    const HofsteeCorners corners{3.0 + 6.0 * rng.uniform(), 10.0 + 5.0 * rng.uniform(), 0.1 * rng.uniform(),
                                 0.3 + 0.5 * rng.uniform()};
    const auto cut = hofstee_cut(scores, corners);
    const auto failing = [&](double at) {
      return static_cast<double>(std::lower_bound(scores.begin(), scores.end(), at) - scores.begin()) /
             static_cast<double>(scores.size());
    };
    if (!cut) {
      EXPECT_TRUE(failing(corners.cut_low) > corners.fail_high || failing(corners.cut_high) < corners.fail_low);
      continue;
    }
    ++found;
    EXPECT_LE(std::abs(*cut - by_search(scores, corners)), 1e-4);
  }
  EXPECT_GT(found, 15);
}

TEST(Hofstee, CutsAtTheScoreWhereTheShareJumps) {
  // Below 6 two in ten fail, at 6.1 seven: the line from (4, .6) to (8, .2) passes between, at 6.
  const HofsteeCorners corners{4, 8, .2, .6};
  EXPECT_EQ(*hofstee_cut({1, 2, 6, 6, 6, 6, 6, 9, 9, 9}, corners), 6.0);
  // Nobody between 4 and 9: half fail wherever the cut is, so the line decides.
  EXPECT_EQ(*hofstee_cut({1, 2, 3, 3, 3, 9, 9, 9, 9, 9}, corners), 5.0);
}

TEST(Hofstee, TakesJudgesAndTurnsOver) {
  const std::map<std::string, std::string> limits = {{"cut_low", "4:5:3"},
                                                     {"cut_high", "8"},
                                                     {"fail_low", "0.2:0.1:0.3"},
                                                     {"fail_high", "0.6"},
                                                     {"resamples", "300"}};
  const std::vector<double> scores = {1, 2, 6, 6, 6, 6, 6, 9, 9, 9};
  const Answer up = run_standard("hofstee", score_table(scores), limits);
  ASSERT_TRUE(up.estimable());
  EXPECT_EQ(*up.estimate, 6.0);
  expect_standard(in_answer(up, "fail_share"), 0.2);
  EXPECT_TRUE(up.ci95);
  std::vector<double> turned = scores;
  for (double& score : turned) score = 10.0 - score;
  std::map<std::string, std::string> low = limits;
  low["direction"] = "lower";
  low["cut_low"] = "2";
  low["cut_high"] = "6:5:7";
  const Answer down = run_standard("hofstee", score_table(turned), low);
  EXPECT_EQ(*down.estimate, 4.0);
  expect_standard(in_answer(down, "fail_share"), 0.2);
}

TEST(Hofstee, RefusesWithAReason) {
  const HofsteeLimits limits{{4}, {8}, {.2}, {.6}};
  EXPECT_EQ(hofstee({1, 2, 3, 4}, 0, limits, true, 0, 1).reason, "too_few");
  EXPECT_EQ(hofstee({1, 1, 1, 1, 1, 2}, 0, limits, true, 0, 1).reason, "no_solution");
  EXPECT_EQ(hofstee({9, 9, 9, 9, 9, 9.5}, 0, limits, true, 0, 1).reason, "no_solution");
  EXPECT_EQ(hofstee({1, 2, 3, 4, 5}, 0, {{8}, {4}, {.2}, {.6}}, true, 0, 1).reason, "bad_value");
  EXPECT_EQ(hofstee({1, 2, 3, 4, 5}, 0, {{4, 5}, {8, 8, 9}, {.2}, {.6}}, true, 0, 1).reason, "bad_value");
}

TEST(Classification, HasTheClosedFormsOfTheBivariateNormal) {
  for (const double rho : {0.1, 0.5, 0.9, 0.99}) {
    // Sheppard's quadrant.
    expect_standard(bivariate_normal_cdf(0.0, 0.0, rho), 0.25 + std::asin(rho) / (2.0 * 3.14159265358979323846),
                    1e-13);
  }
  const Classification at_mean = classification_of(50.0, 10.0, 0.8, 50.0);
  expect_standard(at_mean.consistency, 0.5 + std::asin(0.8) / 3.14159265358979323846, 1e-13);
  expect_standard(at_mean.accuracy, 0.5 + std::asin(std::sqrt(0.8)) / 3.14159265358979323846, 1e-13);
  expect_standard(at_mean.pass, 0.5, 1e-15);
  expect_standard(at_mean.false_pass, at_mean.false_fail, 1e-12);
}

TEST(Classification, MirrorsAndRefuses) {
  const std::vector<double> scores = {40, 45, 52, 57, 61, 66, 70};
  std::vector<double> turned = scores;
  for (double& score : turned) score = -score;
  const Answer up = classification({scores, 0, 50, 0.8, true}), down = classification({turned, 0, -50, 0.8, false});
  expect_standard(*up.estimate, *down.estimate, 1e-12);
  expect_standard(in_answer(up, "pass_share_observed"), in_answer(down, "pass_share_observed"), 1e-12);
  ASSERT_TRUE(up.ci95);
  EXPECT_EQ(classification({{1, 2, 3}, 0, 2, 0.8, true}).reason, "too_few");
  EXPECT_EQ(classification({{2, 2, 2, 2, 2}, 0, 2, 0.8, true}).reason, "no_variation");
  EXPECT_EQ(classification({scores, 0, 50, 1.0, true}).reason, "bad_value");
  EXPECT_EQ(run_standard("classification", score_table(scores), {{"reliability", "0.8"}}).reason, "bad_value");
}

constexpr const char* kCutsOfR = R"(
both <- function(z, k, r) integrate(function(x) dnorm(x) * pnorm((k - r * x) / sqrt(1 - r^2)), -Inf, z, rel.tol = 1e-12, subdivisions = 2000)$value
cuts <- function(name, score, rating, shares, cut, rel) {
  ok <- complete.cases(score, rating); f <- lm(score[ok] ~ rating[ok])
  say(paste0(name, 'line'), sum(coef(f) * c(1, 2))); say(paste0(name, 'r2'), summary(f)$r.squared); say(paste0(name, 'sigma'), summary(f)$sigma)
  t <- t.test(colMeans(shares)); say(paste0(name, 'angoff'), t$estimate); say(paste0(name, 'low'), t$conf.int[1]); say(paste0(name, 'se'), t$stderr)
  s <- score[!is.na(score)]; z <- (cut - mean(s)) / sd(s); k <- z / sqrt(rel)
  pp <- 1 - 2 * pnorm(z) + 2 * both(z, z, rel); ch <- pnorm(z)^2 + pnorm(-z)^2
  say(paste0(name, 'consistency'), pp); say(paste0(name, 'kappa'), (pp - ch) / (1 - ch))
  n <- length(s); t <- sqrt(n) * z
  at <- function(p) uniroot(function(d) pt(t, n - 1, d) - p, t + c(-9, 9) * sqrt(1 + t^2 / (2 * n)), tol = 1e-13)$root / sqrt(n)
  ends <- c(at(.975), at(.025)); same <- function(z) 1 - 2 * pnorm(z) + 2 * both(z, z, rel)
  say(paste0(name, 'same_low'), same(if (prod(ends) < 0) 0 else min(abs(ends)))); say(paste0(name, 'same_high'), same(max(abs(ends))))
  say(paste0(name, 'accuracy'), 1 - pnorm(z) - pnorm(k) + 2 * both(z, k, sqrt(rel)))
}
)";

TEST(Standards, AreThoseOfR) {
  SELDINGER_NEEDS_R();
  std::string script = kCutsOfR;
  struct Set {
    DataTable rated, judged;
    double cut = 0.0, reliability = 0.0;
  };
  std::vector<Set> sets;
  char number[40];
  const auto exactly = [&](double value) {
    std::snprintf(number, sizeof number, "%.17g", value);
    return std::string(number);
  };
  for (std::size_t i = 0; i < fixtures::r_sets(); ++i) {
    base::Rng rng(fixtures::r_seed() + 6000 + i);
    Set set{score_table({}), {}, 45.0 + 10.0 * rng.uniform(), 0.05 + 0.94 * rng.uniform()};
    set.rated.rows = 8 + i;
    for (std::size_t p = 0; p < set.rated.rows; ++p) {
      set.rated.x.push_back(std::floor(1.0 + 4.0 * rng.uniform()));
      set.rated.values.front().values.push_back(40.0 + 5.0 * set.rated.x.back() + 6.0 * rng.normal());
    }
    if (i % 3 == 0) set.rated.values.front().values[2] = std::nan("");
    const std::size_t judges = 2 + i % 6, items = 3 + i % 9;
    set.judged.values.push_back({"share", {}});
    for (std::size_t item = 0; item < items; ++item)
      for (std::size_t judge = 0; judge < judges; ++judge) {
        set.judged.values.front().values.push_back(0.2 + 0.6 * rng.uniform());
        set.judged.subject.push_back("i" + std::to_string(item));
        set.judged.rater.push_back("j" + std::to_string(judge));
      }
    set.judged.rows = items * judges;
    script += "cuts('s" + std::to_string(i) + "_', " + fixtures::r_vector(set.rated.values.front().values) + ", " +
              fixtures::r_vector(set.rated.x) + ", matrix(" + fixtures::r_vector(set.judged.values.front().values) +
              ", " + std::to_string(items) + ", byrow = TRUE), " + exactly(set.cut) + ", " +
              exactly(set.reliability) + ")\n";
    sets.push_back(std::move(set));
  }
  const std::map<std::string, double> want = fixtures::r_values(script);
  for (std::size_t i = 0; i < sets.size(); ++i) {
    SCOPED_TRACE(i);
    const std::string name = "s" + std::to_string(i) + "_";
    const Answer line = run_standard("borderline", sets[i].rated, {{"resamples", "0"}});
    expect_standard(*line.estimate, want.at(name + "line"));
    expect_standard(in_answer(line, "r_squared"), want.at(name + "r2"));
    expect_standard(in_answer(line, "residual_sd"), want.at(name + "sigma"));
    EXPECT_EQ(line.missing, i % 3 == 0 ? 1u : 0u);
    const Answer judged = run_standard("angoff", sets[i].judged, {});
    expect_standard(*judged.estimate, want.at(name + "angoff"));
    expect_standard(judged.ci95->low, std::max(0.0, want.at(name + "low")));
    expect_standard(in_answer(judged, "se"), want.at(name + "se"));
    const Answer decided = run_standard(
        "classification", sets[i].rated,
        {{"cut", exactly(sets[i].cut)}, {"reliability", exactly(sets[i].reliability)}, {"resamples", "0"}});
    expect_standard(*decided.estimate, want.at(name + "consistency"));
    ASSERT_TRUE(decided.ci95);
    expect_standard(decided.ci95->low, want.at(name + "same_low"), 1e-7);
    expect_standard(decided.ci95->high, want.at(name + "same_high"), 1e-7);
    expect_standard(in_answer(decided, "kappa"), want.at(name + "kappa"), 1e-8);
    expect_standard(in_answer(decided, "accuracy"), want.at(name + "accuracy"));
  }
}

TEST(Standards, TakeGroupsByTheirNames) {
  DataTable table = score_table({40, 35, 38, 43, 44, 41, 48, 60, 45, 63, 56, 64});
  table.group = {"n", "n", "n", "n", "n", "n", "e", "e", "e", "e", "e", "e"};
  const Answer named = run_standard("contrasting_groups", table, {{"competent", "e"}, {"resamples", "100"}});
  ASSERT_TRUE(named.estimable());
  EXPECT_EQ(*run_standard("contrasting_groups", table, {{"resamples", "100"}}).estimate, *named.estimate);
  EXPECT_EQ(run_standard("contrasting_groups", table, {{"competent", "n"}}).reason, "no_crossing");
  EXPECT_EQ(run_standard("contrasting_groups", table, {{"competent", "x"}}).reason, "bad_value");
  EXPECT_EQ(run_standard("contrasting_groups", table, {{"seed", "-1"}}).reason, "bad_value");
  table.subject = {"a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "a"};
  EXPECT_EQ(run_standard("contrasting_groups", table, {}).reason, "subject_in_two_groups");
  table.group.assign(12, "n");
  table.subject.clear();
  EXPECT_EQ(run_standard("contrasting_groups", table, {}).reason, "one_group");
}

}  // namespace
}  // namespace seldinger::assessment::statistics
