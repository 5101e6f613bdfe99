// Variance components against Shrout and Fleiss's table and R's aov; decisions against their definition.
#include "assessment/statistics/reliability/g_theory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/assessment/statistics/r_oracle.h"
#include "tests/assessment/statistics/reliability/score_tables.h"

namespace seldinger::assessment::statistics {
namespace {

using fixtures::number_of;

void expect_component(double got, double want, double tolerance = 1e-9) {
  fixtures::note_difference(got, want);
  EXPECT_LE(std::abs(got - want), tolerance * std::max(1.0, std::abs(want))) << got << " for " << want;
}

const fixtures::Rows kSixByFour = {{9, 2, 5, 8}, {6, 1, 3, 2},  {8, 4, 6, 8},
                                   {7, 1, 2, 6}, {10, 5, 6, 9}, {6, 2, 4, 7}};

TEST(GTheory, OfPersonsByCases) {
  const Answer answer = g_theory(fixtures::long_table(kSixByFour), 0.8);
  expect_component(number_of(answer, "var_person"), 2.55555556, 1e-8);
  expect_component(number_of(answer, "var_case"), 5.24444444, 1e-8);
  expect_component(number_of(answer, "var_residual"), 1.01944444, 1e-8);
  expect_component(*answer.estimate, .620050547599, 1e-11);
  expect_component(number_of(answer, "e_rho2"), .909315542377, 1e-11);
  expect_component(number_of(answer, "phi_one_case"), .289763779528, 1e-11);
  EXPECT_EQ(answer.rows[0].name, "1 case");
  expect_component(number_of(answer.rows[0], "e_rho2"), .714840714841, 1e-11);
  ASSERT_TRUE(answer.ci95);
  EXPECT_LT(answer.ci95->low, *answer.estimate);
  EXPECT_GT(answer.ci95->high, *answer.estimate);
}

TEST(GTheory, AsksForNoMoreCasesThanItsTargetDoes) {
  const VarianceComponents of{.person = 2.0,
                              .cases = 0.4,
                              .occasion = 0.01,
                              .person_case = 0.3,
                              .person_occasion = 0.02,
                              .case_occasion = 0.1,
                              .rest = 1.1};
  for (const double target : {0.3, 0.5, 0.8, 0.9, 0.95, 0.99})
    for (const bool relative : {false, true})
      for (const double occasions : {1.0, 3.0}) {
        const auto share = relative ? e_rho2 : phi;
        const auto cases = cases_for(of, target, occasions, relative);
        if (!cases) {
          EXPECT_LT(share(of, 1e12, occasions), target);
          continue;
        }
        EXPECT_GE(share(of, *cases, occasions), target - 1e-9);
        if (*cases > 1.0) {
          EXPECT_LT(share(of, *cases - 1.0, occasions), target);
        }
      }
  // Exactly .8 with four cases.
  EXPECT_EQ(*cases_for({.person = 1.0, .rest = 1.0}, 0.8, 1.0, false), 4.0);
}

TEST(GTheory, SetsNegativeVarianceToZeroAndSaysSo) {
  const Answer answer = g_theory(fixtures::long_table({{1, 5}, {5, 1}, {2, 4}, {4, 2.5}}), 0.8);
  ASSERT_TRUE(answer.estimable());
  EXPECT_EQ(*answer.estimate, 0.0);
  EXPECT_EQ(number_of(answer, "var_person"), 0.0);
  EXPECT_TRUE(std::isnan(number_of(answer, "cases_for_phi")));
  EXPECT_GE(answer.notes.size(), 2u);
}

// Persons by cases by occasions, as rows of a table.
DataTable occasions_table(std::uint64_t seed, std::size_t persons, std::size_t cases, std::size_t occasions) {
  base::Rng rng(seed);
  std::vector<double> of_case, of_occasion;
  for (std::size_t c = 0; c < cases; ++c) of_case.push_back(0.7 * rng.normal());
  for (std::size_t o = 0; o < occasions; ++o) of_occasion.push_back(0.3 * rng.normal());
  DataTable table;
  table.values.push_back({"score", {}});
  for (std::size_t p = 0; p < persons; ++p) {
    const double skill = rng.normal();
    for (std::size_t c = 0; c < cases; ++c) {
      const double suits = 0.5 * rng.normal();
      for (std::size_t o = 0; o < occasions; ++o) {
        table.values.front().values.push_back(skill + of_case[c] + of_occasion[o] + suits + 0.8 * rng.normal());
        table.subject.push_back("p" + std::to_string(p));
        table.rater.push_back("c" + std::to_string(c));
        table.x.push_back(static_cast<double>(o + 1));
      }
    }
  }
  table.rows = table.subject.size();
  return table;
}

TEST(GTheory, RefusesWithAReason) {
  EXPECT_EQ(g_theory(fixtures::long_table({{1}, {2}, {4}}), 0.8).reason, "too_few");
  EXPECT_EQ(g_theory(fixtures::long_table({{1, 2, 3}}), 0.8).reason, "too_few");
  EXPECT_EQ(g_theory(occasions_table(1, 4, 3, 1), 0.8).reason, "too_few");
  EXPECT_EQ(g_theory(occasions_table(1, 4, 1, 3), 0.8).reason, "too_few");
  DataTable hole = occasions_table(1, 4, 3, 2);
  for (std::size_t i = 0; i < hole.rows; ++i)
    if (hole.rater[i] == "c2" && hole.x[i] == 2.0) hole.rater[i].clear();
  EXPECT_EQ(g_theory(hole, 0.8).reason, "unbalanced");
}

// Mean squares of aov, put together by their expectations (Brennan 2001, table 3.3).
constexpr const char* kComponentsOfR = R"(
components <- function(name, d) {
  three <- length(unique(d$o)) > 1
  a <- summary(aov(if (three) y ~ (p + c + o)^2 else y ~ p + c, data = d))[[1]]
  ms <- a[['Mean Sq']]; names(ms) <- gsub(' ', '', rownames(a))
  P <- nlevels(d$p); C <- nlevels(d$c); O <- nlevels(d$o)
  if (!three) {
    v <- c(p = (ms[['p']] - ms[['Residuals']]) / C, c = (ms[['c']] - ms[['Residuals']]) / P, e = ms[['Residuals']])
    say(paste0(name, 'p'), max(0, v['p'])); say(paste0(name, 'c'), max(0, v['c'])); say(paste0(name, 'e'), v['e'])
  } else {
    e <- ms[['Residuals']]
    say(paste0(name, 'p'), max(0, (ms[['p']] - ms[['p:c']] - ms[['p:o']] + e) / (C * O)))
    say(paste0(name, 'c'), max(0, (ms[['c']] - ms[['p:c']] - ms[['c:o']] + e) / (P * O)))
    say(paste0(name, 'o'), max(0, (ms[['o']] - ms[['p:o']] - ms[['c:o']] + e) / (P * C)))
    say(paste0(name, 'pc'), max(0, (ms[['p:c']] - e) / O)); say(paste0(name, 'po'), max(0, (ms[['p:o']] - e) / C))
    say(paste0(name, 'co'), max(0, (ms[['c:o']] - e) / P)); say(paste0(name, 'e'), e)
  }
}
)";

TEST(GTheory, IsThatOfR) {
  SELDINGER_NEEDS_R();
  std::string script = kComponentsOfR;
  std::vector<DataTable> sets;
  for (std::size_t set = 0; set < fixtures::r_sets(); ++set) {
    const std::size_t persons = 5 + set % 7, cases = 2 + set % 4, occasions = 1 + set % 3;
    sets.push_back(occasions_table(fixtures::r_seed() + 4000 + set, persons, cases, occasions));
    script += "d <- expand.grid(o = factor(1:" + std::to_string(occasions) +
              "), c = factor(1:" + std::to_string(cases) + "), p = factor(1:" + std::to_string(persons) +
              ")); d$y <- " + fixtures::r_vector(sets.back().values.front().values) + "\ncomponents('s" +
              std::to_string(set) + "_', d)\n";
    if (occasions == 1) sets.back().x.clear();
  }
  const std::map<std::string, double> want = fixtures::r_values(script);
  for (std::size_t set = 0; set < sets.size(); ++set) {
    SCOPED_TRACE(set);
    const std::string name = "s" + std::to_string(set) + "_";
    const Answer answer = g_theory(sets[set], 0.8);
    ASSERT_TRUE(answer.estimable());
    expect_component(number_of(answer, "var_person"), want.at(name + "p"));
    expect_component(number_of(answer, "var_case"), want.at(name + "c"));
    expect_component(number_of(answer, "var_residual"), want.at(name + "e"));
    if (sets[set].x.empty()) continue;
    expect_component(number_of(answer, "var_occasion"), want.at(name + "o"));
    expect_component(number_of(answer, "var_person_case"), want.at(name + "pc"));
    expect_component(number_of(answer, "var_person_occasion"), want.at(name + "po"));
    expect_component(number_of(answer, "var_case_occasion"), want.at(name + "co"));
    const double c = number_of(answer, "cases"), o = number_of(answer, "occasions"), p = want.at(name + "p");
    const double error = want.at(name + "c") / c + want.at(name + "o") / o + want.at(name + "pc") / c +
                         want.at(name + "po") / o + (want.at(name + "co") + want.at(name + "e")) / (c * o);
    expect_component(*answer.estimate, p / (p + error));
  }
}

}  // namespace
}  // namespace seldinger::assessment::statistics
