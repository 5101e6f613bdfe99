#include "assessment/statistics/relations/relations_procedures.h"

#include "assessment/statistics/relations/bootstrap.h"
#include "assessment/statistics/relations/correlation.h"
#include "assessment/statistics/relations/counts.h"
#include "assessment/statistics/relations/discrimination.h"
#include "assessment/statistics/relations/fisher_exact.h"
#include "assessment/statistics/relations/imputation.h"
#include "assessment/statistics/relations/proportions.h"
#include "assessment/statistics/relations/survival.h"
#include "assessment/statistics/relations/tobit.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr ProcedureOption kOrderOnly[] = {
    {"order", "names of groups, with : between them",
     "which groups, in which order; the first is compared with the second"},
};
constexpr ProcedureOption kReliabilities[] = {
    {"reliability_x", "a number above 0 and up to 1", "reliability of x, to correct for attenuation"},
    {"reliability_y", "a number above 0 and up to 1", "reliability of the value, to correct for attenuation"},
};
constexpr ProcedureOption kSides[] = {
    kOrderOnly[0],
    {"positive", "the name of a group",
     "the group that should have the higher values; the last by name unless given"},
};
constexpr ProcedureOption kHorizon[] = {
    kOrderOnly[0],
    {"tau", "a time above 0", "up to when; the earliest group's longest time unless given"},
};
constexpr ProcedureOption kLimit[] = {
    kOrderOnly[0],
    {"limit", "a number", "values there or beyond are censored; required"},
    {"side", "upper, lower", "at which end values are censored; upper unless given"},
};
constexpr ProcedureOption kDraws[] = {
    kOrderOnly[0],
    {"statistic", "mean, median", "what is estimated, with two groups its difference; mean unless given"},
    {"resamples", "a whole number from 200 to 100000", "draws of persons; 5000 unless given"},
    {"seed", "a whole number", "what the draws are made from; 1 unless given"},
};
constexpr ProcedureOption kImputations[] = {
    kOrderOnly[0],
    {"draws", "a whole number from 10 to 500", "how often what is missing is drawn; 50 unless given"},
    {"seed", "a whole number", "what the draws are made from; 1 unless given"},
};
constexpr Needs kGrouped{.group = true};
constexpr Needs kRelated{.x = true};
constexpr Needs kTwoValues{.least_values = 2, .most_values = 2, .group = true};
constexpr Needs kGroupedTimes{.group = true, .x = true};

constexpr Procedure kRelationsProcedures[] = {
    {"wilson", "The share of persons who passed, with its interval; take it for one rate, or one in each group.",
     "value: 0 failed, 1 passed; group: optional", Needs{}, kOrderOnly, one_proportion,
     "Wilson, J. Am. Stat. Assoc. 22 (1927) 209; Clopper, Pearson, Biometrika 26 (1934) 404",
     "R prop.test and binom.test; 1e-9"},
    {"fisher", "Whether two groups differ in the share that passed; take it for two small groups.",
     "value: 0 failed, 1 passed, by group; two groups", kGrouped, kOrderOnly, fisher_exact,
     "Fisher, J. R. Stat. Soc. 98 (1935) 39; Newcombe, Stat. Med. 17 (1998) 873",
     "R fisher.test for p, 1e-9; its odds ratio and interval with uniroot to 1e-13, 1e-9; Newcombe's published "
     "table"},
    {"pearson",
     "How two measurements go together on a straight line; take it for values near a normal distribution.",
     "value and x, a person a row", kRelated, kReliabilities, pearson,
     "Fisher, Metron 1 (1921) 3; Spearman, Am. J. Psychol. 15 (1904) 72 (attenuation)", "R cor.test; 1e-9"},
    {"spearman", "How two measurements go together in rank; take it for ratings and skewed values.",
     "value and x, a person a row", kRelated, kReliabilities, spearman,
     "Spearman, Am. J. Psychol. 15 (1904) 72; Bonett, Wright, Psychometrika 65 (2000) 23",
     "R cor.test, exact up to 9 persons without ties; orders counted with ties; 1e-9"},
    {"kendall", "How often two measurements rank a pair of persons alike; take it for few persons and many ties.",
     "value and x, a person a row", kRelated, kReliabilities, kendall,
     "Kendall, Biometrika 30 (1938) 81; Fieller, Hartley, Pearson, Biometrika 44 (1957) 470; Bonett, Wright, "
     "Psychometrika 65 (2000) 23",
     "R cor.test, exact below 50 persons without ties; orders counted with ties; 1e-9"},
    {"auc", "How well a value tells two groups apart; take it for novices against experts.",
     "value by group; two groups", kGrouped, kSides, auc,
     "DeLong, DeLong, Clarke-Pearson, Biometrics 44 (1988) 837; Newcombe, Stat. Med. 25 (2006) 559",
     "pROC auc, var, coords; 1e-9"},
    {"delong", "Which of two values tells two groups better apart, on the same persons.",
     "two values by group; two groups", kTwoValues, kSides, delong,
     "DeLong, DeLong, Clarke-Pearson, Biometrics 44 (1988) 837", "pROC roc.test; 1e-9"},
    {"poisson", "Whether two groups differ in a rate of counts; take it where persons differ by chance only.",
     "value: counts, by group; x: exposure, optional; two groups", kGrouped, kOrderOnly, poisson,
     "Przyborowski, Wilenski, Biometrika 31 (1940) 313", "R poisson.test; 1e-9"},
    {"negative_binomial",
     "Whether two groups differ in a rate of counts; take it where persons differ, as they do.",
     "value: counts, by group; x: exposure, optional; two groups", kGrouped, kOrderOnly, negative_binomial,
     "Lawless, Can. J. Stat. 15 (1987) 209", "MASS glm.nb; 1e-6"},
    {"kaplan_meier", "The share not there yet, over time; take it for time to target with persons who gave up.",
     "value: time; x: 1 event, 0 gave up or time ran out; group: optional", kRelated, kOrderOnly, kaplan_meier,
     "Kaplan, Meier, J. Am. Stat. Assoc. 53 (1958) 457", "survival survfit, conf.type log-log; 1e-9"},
    {"log_rank", "Whether groups differ in their times to an event; take it with persons who gave up.",
     "value: time; x: 1 event, 0 censored; by group", kGroupedTimes, kOrderOnly, log_rank,
     "Mantel, Cancer Chemother. Rep. 50 (1966) 163; Yusuf et al., Prog. Cardiovasc. Dis. 27 (1985) 335 (Peto)",
     "survival survdiff; 1e-9"},
    {"rmst", "Mean time to an event up to a horizon, and its difference; take it for a difference in seconds.",
     "value: time; x: 1 event, 0 censored; by group; one or two groups", kRelated, kHorizon, rmst,
     "Royston, Parmar, BMC Med. Res. Methodol. 13 (2013) 152", "survival survfit, rmean; 1e-9"},
    {"tobit", "Difference of means where values end at a limit; take it for scores with a ceiling.",
     "value by group; two groups", kGrouped, kLimit, tobit,
     "Tobin, Econometrica 26 (1958) 24; Olsen, Econometrica 46 (1978) 1211", "AER tobit; 1e-6"},
    {"imputed",
     "Difference of two means where some persons have no value: multiple imputation; take it alongside those who "
     "have one.",
     "value by group, empty where it is missing; x: what the values depend on, optional; two groups", kGrouped,
     kImputations, imputed,
     "Rubin, Multiple Imputation for Nonresponse in Surveys, 1987; Barnard, Rubin, Biometrika 86 (1999) 948",
     "mice pool.scalar, 1e-9; R t.test of each completed table, 1e-9; its draws against R lm and Student's t of "
     "the "
     "posterior, by their moments; coverage"},
    {"bootstrap", "Interval of a mean, a median or their difference, whatever the distribution.",
     "value; group: optional, two groups", Needs{}, kDraws, bootstrap,
     "Efron, J. Am. Stat. Assoc. 82 (1987) 171; Davison, Hinkley, Bootstrap Methods, 1997",
     "R and boot boot.ci on the same matrix of indices; 1e-9"},
};

}  // namespace

std::span<const Procedure> relations_procedures() {
  return kRelationsProcedures;
}

}  // namespace seldinger::assessment::statistics
