// Every procedure with every option on tables that nobody should bring: no NaN, no infinity, no end; always a
// reason.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "assessment/statistics/groups/groups_procedures.h"
#include "assessment/statistics/reasons.h"
#include "sim/base/rng.h"
#include "tests/assessment/statistics/groups/tables.h"

namespace seldinger::assessment::statistics {
namespace {

// SELDINGER_DEGENERATE tables for each procedure; 100 make 2,000 for the shelf.
std::size_t tables_asked() {
  const char* asked = std::getenv("SELDINGER_DEGENERATE");
  return asked != nullptr ? static_cast<std::size_t>(std::strtoul(asked, nullptr, 10)) : 100;
}

std::size_t one_of(base::Rng& rng, std::size_t n) {
  return static_cast<std::size_t>(rng.uniform() * static_cast<double>(n));
}

// Each kind draws from values that belong together: huge and small alone, then mixed.
double bad_value(base::Rng& rng, std::size_t kind) {
  constexpr double kExtremes[] = {1e300, -1e300, 1e-320, -1e-320, 0.0, -0.0, 1.7e308, -1.7e308};
  const double unit = rng.uniform();
  switch (kind) {
    case 0:
      return 3.0;  // a constant
    case 1:
      return std::floor(4.0 * unit);  // ties
    case 2:
      return rng.normal();
    case 3:
      return kExtremes[one_of(rng, std::size(kExtremes))];
    case 4:
      return (unit - 0.5) * 2e300;
    case 5:
      return unit * 1e-320;
    case 6:
      return 1e9 + std::floor(3.0 * unit) * 1e-7;  // alike but for the last bits
    case 7:
      return unit < 0.5 ? std::nan("") : std::floor(3.0 * unit);
    case 8:
      return unit;  // a share or a p-value
    default:
      return unit < 0.3 ? std::nan("") : unit < 0.6 ? kExtremes[one_of(rng, 8)] : rng.normal();
  }
}

DataTable bad_table(base::Rng& rng, const Needs& needs) {
  DataTable table;
  table.rows = one_of(rng, 9) * (one_of(rng, 4) == 0 ? 4 : 1);
  const std::size_t groups = one_of(rng, 2) == 0 ? 2 : 1 + one_of(rng, 4), persons = 1 + one_of(rng, 9);
  const std::size_t columns = needs.most_values > 1 ? needs.least_values + one_of(rng, 3) : needs.least_values;
  for (std::size_t c = 0; c < columns; ++c) {
    table.values.push_back({"v" + std::to_string(c), {}});
    const std::size_t kind = one_of(rng, 10);
    for (std::size_t i = 0; i < table.rows; ++i) table.values.back().values.push_back(bad_value(rng, kind));
  }
  const bool design = rng.uniform() < 0.5;  // every person under every condition
  for (std::size_t i = 0; i < table.rows; ++i) {
    const std::size_t group = design ? i % groups : one_of(rng, groups);
    if (needs.group || groups > 2)
      table.group.push_back(one_of(rng, 30) == 0 ? "" : std::string(1, static_cast<char>('a' + group)));
    if (needs.subject)
      table.subject.push_back("p" + std::to_string(design ? i / groups : one_of(rng, persons)));
    else if (design && groups == 4)
      table.subject.push_back(one_of(rng, 30) == 0 ? "" : "p" + std::to_string(i));
  }
  return table;
}

ProcedureOptions bad_options(base::Rng& rng, const Procedure& procedure) {
  const char* kTexts[] = {"",      "a:b",        "b:a",    "a:b:c", "a:a", "z",    "::", "drop", "pratt",
                          "auto",  "asymptotic", "1",      "0.5",   "-1",  "2",    "20", "0.8",  "0.05",
                          "1e300", "-1e300",     "1e-320", "nan",   "inf", "1000", "x"};
  std::map<std::string, std::string> options;
  // What these cannot do without, most times.
  if (procedure.name == std::string("tost") && rng.uniform() < 0.7) options["margin"] = "1";
  if (procedure.name == std::string("power") && rng.uniform() < 0.7) options = {{"n", "20"}, {"d", "0.8"}};
  for (const ProcedureOption& option : procedure.options)
    if (rng.uniform() < 0.15) options[option.name] = kTexts[one_of(rng, std::size(kTexts))];
  return ProcedureOptions(options);
}

void expect_sound(const Answer& answer) {
  if (!answer.estimable()) {
    EXPECT_NE(find_reason(answer.reason.c_str()), nullptr) << answer.reason;
    EXPECT_FALSE(answer.estimate || answer.statistic || answer.p_value || answer.ci95);
    return;
  }
  std::vector<double> numbers = answer.df;
  for (const std::optional<double>& one : {answer.statistic, answer.p_value, answer.estimate})
    if (one) numbers.push_back(*one);
  if (answer.ci95) {
    numbers.insert(numbers.end(), {answer.ci95->low, answer.ci95->high});
    EXPECT_LE(answer.ci95->low, answer.ci95->high);
    if (answer.estimate) {
      // An interval that two roundings away from the estimate ends holds it.
      const double slack = 1e-12 * std::abs(*answer.estimate);
      EXPECT_LE(answer.ci95->low, *answer.estimate + slack);
      EXPECT_GE(answer.ci95->high, *answer.estimate - slack);
    }
  }
  for (const Named& one : answer.more) numbers.push_back(one.value);
  for (const Row& row : answer.rows)
    for (const Named& one : row.values) {
      numbers.push_back(one.value);
      if (one.name.rfind("p", 0) == 0) {
        EXPECT_TRUE(one.value >= 0.0 && one.value <= 1.0) << one.name << one.value;
      }
    }
  EXPECT_FALSE(numbers.empty());
  EXPECT_TRUE(std::all_of(numbers.begin(), numbers.end(), [](double one) { return std::isfinite(one); }));
  EXPECT_TRUE(!answer.p_value || (*answer.p_value >= 0.0 && *answer.p_value <= 1.0)) << *answer.p_value;
  EXPECT_FALSE(answer.method.empty());
}

TEST(Degenerate, EveryProcedureAnswersOrSaysWhyNot) {
  for (const Procedure& procedure : groups_procedures()) {
    std::size_t answered = 0;
    for (std::size_t i = 0; i < tables_asked(); ++i) {
      base::Rng rng(i * 1000 + static_cast<std::size_t>(&procedure - groups_procedures().data()));
      const DataTable table = bad_table(rng, procedure.needs);
      const Answer answer = procedure.run(table, bad_options(rng, procedure));
      SCOPED_TRACE(std::string(procedure.name) + ", table " + std::to_string(i));
      EXPECT_EQ(answer.test, procedure.name);
      expect_sound(answer);
      answered += answer.estimable() ? 1 : 0;
      if (testing::Test::HasFailure()) return;
    }
    // The sweep is about answers too, not about refusals only.
    EXPECT_GT(answered, tables_asked() / 50) << procedure.name;
    EXPECT_LT(answered, tables_asked()) << procedure.name;
  }
}

std::string why(const Procedure& procedure, const DataTable& table, const ProcedureOptions& options = {}) {
  return procedure.run(table, options).reason;
}

const Procedure& named(const std::string& name) {
  for (const Procedure& procedure : groups_procedures())
    if (procedure.name == name) return procedure;
  ADD_FAILURE() << name;
  return groups_procedures().front();
}

TEST(Degenerate, ReasonsAreTheRightOnes) {
  const DataTable constants = table_of({{"a", {1, 1, 1}}, {"b", {2, 2, 2}}});
  for (const char* name : {"welch", "student", "welch_anova", "brown_forsythe", "tost"})
    EXPECT_EQ(why(named(name), constants, name == std::string("tost") ? with({{"margin", "1"}}) : with({})),
              "no_variation_within")
        << name;
  const DataTable same = table_of({{"a", {1, 1, 1}}, {"b", {1, 1, 1}}});
  for (const char* name : {"mann_whitney", "brunner_munzel", "kruskal", "dunn", "jonckheere"})
    EXPECT_EQ(why(named(name), same), "all_tied") << name;
  const DataTable alone = table_of({{"a", {1}}, {"b", {1, 2, 3}}});
  for (const char* name : {"welch", "student", "welch_anova", "brunner_munzel", "effect_size"})
    EXPECT_EQ(why(named(name), alone), "group_too_small") << name;
  EXPECT_EQ(why(named("mann_whitney"), alone), "");
  EXPECT_EQ(why(named("shapiro"), table_of({5, 5, 5, 5})), "no_variation");
  EXPECT_EQ(why(named("shapiro"), table_of({5, 6})), "too_few");
  EXPECT_EQ(why(named("shapiro"), table_of(std::vector<double>(5001, 1.0))), "too_many");
  EXPECT_EQ(why(named("welch"), table_of({{"a", {1, 2, 3}}})), "one_group");
  EXPECT_EQ(why(named("welch"), table_of({{"a", {1, 2}}, {"b", {2, 4}}, {"c", {3, 5}}})), "not_two_groups");
  EXPECT_EQ(why(named("welch"), table_of({{"a", {1, 2}}, {"b", {2, 4}}, {"c", {3, 5}}}), with({{"order", "c:a"}})),
            "");
  EXPECT_EQ(why(named("welch"), table_of({{"a", {1e300, -1e300}}, {"b", {2, 4}}})), "no_finite_answer");
  EXPECT_EQ(why(named("welch"), table_of({{"a", {1e-200, 2e-200}}, {"b", {3e-200, 4e-200}}})), "no_finite_answer");
  EXPECT_EQ(why(named("holm"), table_of({0.5, 1.5})), "bad_value");
  EXPECT_EQ(why(named("paired"), table_of_persons({{"a", {1, 2, 3}}, {"b", {2, 3, 4}}})), "no_variation");
  EXPECT_EQ(why(named("wilcoxon"), table_of_persons({{"a", {1, 2, 3}}, {"b", {1, 2, 3}}})), "no_difference");
}

TEST(Degenerate, ThePersonIsTheUnit) {
  DataTable repeated = table_of({{"a", {1, 2, 3}}, {"b", {4, 5, 7}}});
  repeated.subject = {"p", "p", "q", "r", "s", "t"};
  DataTable in_both = repeated;
  in_both.subject = {"p", "q", "r", "p", "s", "t"};
  for (const char* name : {"welch", "student", "mann_whitney", "brunner_munzel", "kruskal", "dunn", "welch_anova",
                           "brown_forsythe", "jonckheere", "effect_size", "max_t"}) {
    EXPECT_EQ(why(named(name), repeated), "repeated_subject") << name;
    EXPECT_EQ(why(named(name), in_both), "subject_in_two_groups") << name;
  }
  for (const char* name : {"paired", "wilcoxon", "friedman"})
    EXPECT_EQ(why(named(name), repeated), "repeated_subject") << name;
  EXPECT_EQ(why(named("describe"), in_both), "");
  EXPECT_EQ(why(named("describe"), repeated), "repeated_subject");
}

}  // namespace
}  // namespace seldinger::assessment::statistics
