#include "assessment/statistics/groups/groups_procedures.h"

#include "assessment/statistics/groups/brunner_munzel.h"
#include "assessment/statistics/groups/describe.h"
#include "assessment/statistics/groups/effect_sizes.h"
#include "assessment/statistics/groups/mann_whitney.h"
#include "assessment/statistics/groups/multiplicity.h"
#include "assessment/statistics/groups/power.h"
#include "assessment/statistics/groups/rank_tests.h"
#include "assessment/statistics/groups/shapiro_wilk.h"
#include "assessment/statistics/groups/signed_rank.h"
#include "assessment/statistics/groups/t_tests.h"
#include "assessment/statistics/groups/variance_analysis.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr ProcedureOption kOrder = {"order", "groups as a:b",
                                    "which group is first; groups that it does not name are left out"};
constexpr ProcedureOption kSeveralOrder = {
    "order", "groups as a:b:c", "the order in which groups are listed; those that it does not name are left out"};
constexpr ProcedureOption kDraws = {"draws", "1000 to 1000000", "permutations drawn where there are more; 10000"};
constexpr ProcedureOption kSeed = {"seed", "a whole number", "of the permutations drawn; 1"};

constexpr ProcedureOption kTwo[] = {kOrder};
constexpr ProcedureOption kSeveral[] = {kSeveralOrder};
constexpr ProcedureOption kTrend[] = {
    {"order", "groups as a:b:c", "in which order values are expected to rise; else that of the rows"}};
constexpr ProcedureOption kMannWhitney[] = {
    kOrder,
    {"method", "auto or asymptotic", "auto: exact up to 100 persons; asymptotic: by the normal distribution"}};
constexpr ProcedureOption kWilcoxon[] = {
    kOrder, {"zeros", "drop or pratt", "pairs that do not differ: left out before ranks are given, or after"}};
constexpr ProcedureOption kPermuted[] = {kOrder, kDraws, kSeed};
constexpr ProcedureOption kMargins[] = {kOrder,
                                        {"margin", "a number above 0", "differences within ± this count as none"},
                                        {"low", "a number below 0", "with high: margins of their own"},
                                        {"high", "a number above 0", "with low"}};
constexpr ProcedureOption kPlan[] = {{"n", "2 or more", "persons in each group"},
                                     {"n1", "2 or more", "persons in the first group, with n2"},
                                     {"n2", "2 or more", "persons in the second group, with n1"},
                                     {"d", "above 0", "difference of means in standard deviations"},
                                     {"power", "0.01 to 0.9999", "chance to find it"},
                                     {"alpha", "1e-6 to 0.5", "two-sided level; 0.05"},
                                     {"p", "0.501 to 0.999", "P(X < Y): plans a rank test by Noether"},
                                     {"share", "0.01 to 0.99", "of persons in the first group, with p; 0.5"}};

constexpr const char* kTwoColumns = "value by group; two groups";
constexpr const char* kSeveralColumns = "value by group; two groups or more";
constexpr const char* kPairedColumns = "value by subject, the two conditions in the group column";

constexpr Needs kValue{}, kGroups{.group = true}, kPersons{.group = true, .subject = true};
constexpr Needs kOutcomes{.least_values = 1, .most_values = 1000, .group = true};
constexpr Needs kNothing{.least_values = 0, .most_values = 0};

constexpr Procedure kProcedures[] = {
    {"describe", "What values look like: middle, spread, ends, and the interval of the mean.",
     "value; by group where given", kValue, kSeveral, describe, "Hyndman and Fan 1996, type 7",
     "R mean, sd, quantile, mad, t.test: 1e-9"},
    {"shapiro",
     "Whether values may be normal; take it to describe, not to choose a test.",
     "value; by group where given",
     kValue,
     {},
     shapiro,
     "Royston 1995, AS R94",
     "R shapiro.test: 1e-6"},
    {"brown_forsythe", "Whether groups spread alike.", kSeveralColumns, kGroups, kSeveral, brown_forsythe,
     "Brown and Forsythe 1974", "R car::leveneTest: 1e-9"},
    {"welch", "Difference of two means; the default for differences.", kTwoColumns, kGroups, kTwo, welch,
     "Welch 1947", "R t.test: 1e-9"},
    {"student", "Difference of two means with equal variances; only where a plan asks for it.", kTwoColumns,
     kGroups, kTwo, student, "Student 1908", "R t.test, var.equal: 1e-9"},
    {"paired", "Mean difference of the same persons under two conditions.", kPairedColumns, kPersons, kTwo, paired,
     "Student 1908", "R t.test, paired: 1e-9"},
    {"mann_whitney", "Whether two groups have one distribution, by ranks, with the shift between them.",
     kTwoColumns, kGroups, kMannWhitney, mann_whitney,
     "Mann and Whitney 1947; Hodges and Lehmann 1963; Streitberg and Röhmel 1987",
     "R exactRankTests::wilcox.exact, coin, wilcox.test, enumeration: 1e-9"},
    {"brunner_munzel", "Whether one group's values tend to be larger, shapes unlike; the default for order.",
     kTwoColumns, kGroups, kPermuted, brunner_munzel, "Brunner and Munzel 2000; Neubert and Brunner 2007",
     "SciPy brunnermunzel: 1e-9; permutation by enumeration"},
    {"wilcoxon", "Differences of the same persons under two conditions, by ranks.", kPairedColumns, kPersons,
     kWilcoxon, wilcoxon, "Wilcoxon 1945; Pratt 1959; Streitberg and Röhmel 1987",
     "R exactRankTests::wilcox.exact, wilcox.test, coin, enumeration: 1e-9"},
    {"kruskal", "Whether several groups have one distribution, by ranks.", kSeveralColumns, kGroups, kSeveral,
     kruskal, "Kruskal and Wallis 1952", "R kruskal.test: 1e-9"},
    {"dunn", "Which of several groups differ, by ranks; after kruskal.", kSeveralColumns, kGroups, kSeveral, dunn,
     "Dunn 1964; Holm 1979", "R rstatix::dunn_test: 1e-9"},
    {"welch_anova", "Whether means of several groups differ; the default for several.", kSeveralColumns, kGroups,
     kSeveral, welch_anova, "Welch 1951", "R oneway.test: 1e-9"},
    {"jonckheere", "Whether values rise in an order of groups stated beforehand.", kSeveralColumns, kGroups, kTrend,
     jonckheere, "Jonckheere 1954; Terpstra 1952", "identities by cor.test Kendall and two-group ranks: 1e-9"},
    {"friedman", "Whether conditions differ within persons, by ranks.",
     "value by subject, conditions in the group column", kPersons, kSeveral, friedman, "Friedman 1937",
     "R friedman.test: 1e-9"},
    {"effect_size", "How large a difference of two groups is: d, g, Δ, δ, with intervals.", kTwoColumns, kGroups,
     kTwo, effect_size, "Hedges 1981; Steiger and Fouladi 1997; Cliff 1993",
     "R effectsize: estimates 1e-9, intervals 1e-6"},
    {"tost", "Whether two means are equal within margins stated beforehand.", kTwoColumns, kGroups, kMargins, tost,
     "Schuirmann 1987", "R t.test, one-sided, twice: 1e-9"},
    {"max_t", "Which of several outcomes differ between two groups, knowing how they go together.",
     "a column of values for each outcome, by group; two groups", kOutcomes, kPermuted, max_t,
     "Westfall and Young 1993", "R multtest::mt.maxT, all permutations: 1e-9"},
    {"holm",
     "Several p-values as one family: none falsely significant, with 95 %.",
     "p-values as values",
     kValue,
     {},
     holm,
     "Holm 1979",
     "R p.adjust: 1e-12"},
    {"bh",
     "Several p-values explored: at most 5 % false among the significant.",
     "p-values as values",
     kValue,
     {},
     bh,
     "Benjamini and Hochberg 1995",
     "R p.adjust: 1e-12"},
    {"power", "Power, sample size or detectable difference of two groups.", "none", kNothing, kPlan, power,
     "Cohen 1988; Noether 1987", "R power.t.test, pwr: 1e-9"},
};

}  // namespace

std::span<const Procedure> groups_procedures() {
  return kProcedures;
}

}  // namespace seldinger::assessment::statistics
