#include "assessment/statistics/reliability/reliability_procedures.h"

#include <algorithm>
#include <array>
#include <string>

#include "assessment/statistics/reliability/alpha.h"
#include "assessment/statistics/reliability/icc.h"
#include "assessment/statistics/reliability/kappa.h"
#include "assessment/statistics/reliability/omega.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr std::size_t kMostColumns = 200;
constexpr std::size_t kMostDraws = 100000;
constexpr std::size_t kMostSeed = 4294967295;

constexpr Needs kScores{.least_values = 1, .most_values = kMostColumns};
constexpr Needs kItems{.least_values = 2, .most_values = kMostColumns};

constexpr ProcedureOption kIccOptions[] = {
    {"form", "icc1, icc2, icc3, icc1k, icc2k, icc3k", "which coefficient is the answer; icc2 unless given"},
};
constexpr ProcedureOption kKappaOptions[] = {
    {"weights", "none, linear, quadratic", "what near misses are worth; none unless given"},
};
constexpr ProcedureOption kItemOptions[] = {
    {"reverse", "items, with : between them", "items that run against the scale; needs low and high"},
    {"low", "a number", "the lower end of the items' scale; an answer below it is refused"},
    {"high", "a number", "the upper end of the items' scale; an answer above it is refused"},
};
constexpr ProcedureOption kOmegaOptions[] = {
    kItemOptions[0],
    kItemOptions[1],
    kItemOptions[2],
    {"resamples", "a whole number up to 100000",
     "draws of persons for the interval; 1000 unless given, 0 for none"},
    {"seed", "a whole number", "what the draws are made from; 1 unless given"},
};

Answer bad_option(const char* test, const char* name, const DataTable& table) {
  Answer answer = not_estimable(test, "bad_value", table.rows);
  answer.notes.push_back(std::string("The option ") + name + " is not what it takes.");
  return answer;
}

Answer run_icc(const DataTable& table, const ProcedureOptions& options) {
  const std::string asked = options.text("form", "icc2");
  for (std::size_t i = 0; i < kIccForms.size(); ++i)
    if (asked == kIccForms[i].name) return icc(complete_table(table), i);
  return bad_option("icc", "form", table);
}

Answer run_kappa(const DataTable& table, const ProcedureOptions& options) {
  const std::string asked = options.text("weights", "none");
  if (asked == "none") return kappa(complete_table(table), KappaWeights::kNone);
  if (asked == "linear") return kappa(complete_table(table), KappaWeights::kLinear);
  if (asked == "quadratic") return kappa(complete_table(table), KappaWeights::kQuadratic);
  return bad_option("kappa", "weights", table);
}

// A questionnaire has a column for each item and a row for each person, whoever rated them.
CompleteTable items_of(const DataTable& table) {
  DataTable items = table;
  items.rater.clear();
  return complete_table(items);
}

// `bad`: the option that is not what it takes.
ItemScale scale_of(const ProcedureOptions& options, const char*& bad) {
  ItemScale scale;
  scale.reverse = options.list("reverse");
  for (const char* name : {"low", "high"}) {
    if (!options.has(name)) continue;
    const std::optional<double> end = options.number(name, 0.0);
    if (!end) bad = name;
    (std::string(name) == "low" ? scale.low : scale.high) = end;
  }
  return scale;
}

Answer run_alpha(const DataTable& table, const ProcedureOptions& options) {
  const char* bad = nullptr;
  const ItemScale scale = scale_of(options, bad);
  if (bad != nullptr) return bad_option("alpha", bad, table);
  return alpha(items_of(table), scale);
}

Answer run_omega(const DataTable& table, const ProcedureOptions& options) {
  const char* bad = nullptr;
  const ItemScale scale = scale_of(options, bad);
  const auto draws = options.whole("resamples", 1000, 0, kMostDraws), seed = options.whole("seed", 1, 0, kMostSeed);
  if (!draws) bad = "resamples";
  if (!seed) bad = "seed";
  if (bad != nullptr) return bad_option("omega", bad, table);
  return omega(items_of(table), scale, *draws, *seed);
}

constexpr const char* kScoreColumns =
    "value by subject and rater, one score for each pair; or a column of values for each rater, a row a subject";
constexpr const char* kItemColumns = "a column of values for each item, a row a person";

constexpr Procedure kReliability[] = {
    {"icc", "How alike several scores of the same subject are: raters, cases or repetitions, measured on a scale.",
     kScoreColumns, kScores, kIccOptions, run_icc,
     "Shrout, Fleiss, Psychol Bull 1979;86:420; McGraw, Wong, Psychol Methods 1996;1:30; Weir, J Strength Cond Res "
     "2005;19:231",
     "Shrout and Fleiss's table and psych::ICC, 1e-9"},
    {"kappa", "How far raters agree on categories beyond chance.", kScoreColumns, kScores, kKappaOptions, run_kappa,
     "Cohen, Psychol Bull 1968;70:213; Fleiss, Cohen, Everitt, Psychol Bull 1969;72:323; Light, Psychol Bull "
     "1971;76:365",
     "psych::cohen.kappa, 1e-9"},
    {"alpha", "Whether the items of a questionnaire hang together, and which do not.", kItemColumns, kItems,
     kItemOptions, run_alpha,
     "Cronbach, Psychometrika 1951;16:297; Feldt, Psychometrika 1965;30:357; Guttman, Psychometrika 1945;10:255",
     "psych::alpha and R's attitude, 1e-9"},
    {"omega", "The share of a questionnaire's variance that one thing behind its items explains.", kItemColumns,
     kItems, kOmegaOptions, run_omega, "McDonald, Test theory, 1999; Joreskog, Psychometrika 1967;32:443",
     "factanal and psych::fa, 1e-6"},
};

}  // namespace

std::span<const Procedure> reliability_procedures() {
  return kReliability;
}

}  // namespace seldinger::assessment::statistics
