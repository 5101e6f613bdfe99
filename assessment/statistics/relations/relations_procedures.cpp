#include "assessment/statistics/relations/relations_procedures.h"

#include "assessment/statistics/relations/correlation.h"
#include "assessment/statistics/relations/fisher_exact.h"
#include "assessment/statistics/relations/proportions.h"

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
constexpr Needs kGrouped{.group = true};
constexpr Needs kRelated{.x = true};

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
};

}  // namespace

std::span<const Procedure> relations_procedures() {
  return kRelationsProcedures;
}

}  // namespace seldinger::assessment::statistics
