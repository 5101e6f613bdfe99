#include "assessment/statistics/reliability/reliability_procedures.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include "assessment/statistics/reliability/alpha.h"
#include "assessment/statistics/reliability/bland_altman.h"
#include "assessment/statistics/reliability/g_theory.h"
#include "assessment/statistics/reliability/grim.h"
#include "assessment/statistics/reliability/icc.h"
#include "assessment/statistics/reliability/kappa.h"
#include "assessment/statistics/reliability/omega.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr std::size_t kMostColumns = 200;
constexpr std::size_t kMostDraws = 100000;
constexpr std::size_t kMostSeed = 4294967295;

constexpr Needs kScores{.least_values = 1, .most_values = kMostColumns};
constexpr Needs kTwoColumns{.least_values = 1, .most_values = 2};
constexpr Needs kPersonsByCases{.subject = true, .rater = true};
constexpr Needs kNothing{.least_values = 0, .most_values = 0};
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

constexpr ProcedureOption kBlandAltmanOptions[] = {
    {"widths", "a number above 0", "how many standard deviations the limits lie from the bias; 1.96 unless given"},
};
constexpr ProcedureOption kGTheoryOptions[] = {
    {"phi", "a number between 0 and 1", "what the number of cases is asked to reach; 0.8 unless given"},
};
constexpr ProcedureOption kGrimmerOptions[] = {
    {"n", "a whole number", "how many persons the paper reports"},
    {"mean", "a number, as it is printed", "the mean; its decimals count"},
    {"decimals", "a whole number up to 8", "of the mean, where its last ones are not typed"},
    {"items", "a whole number up to 100", "answers that a person's score is the mean of; 1 unless given"},
    {"low", "a whole number", "the lower end of the scale"},
    {"high", "a whole number", "the upper end of the scale"},
    {"sd", "a number, as it is printed", "the standard deviation; its decimals count"},
    {"sd_decimals", "a whole number up to 8", "of the standard deviation, where its last ones are not typed"},
};
constexpr std::span<const ProcedureOption> kGrimOptions = std::span(kGrimmerOptions).first(6);

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

Answer run_bland_altman(const DataTable& table, const ProcedureOptions& options) {
  const std::optional<double> widths = options.number("widths", 1.96);
  if (!widths || !(*widths > 0.0) || *widths > 100.0) return bad_option("bland_altman", "widths", table);
  return bland_altman(complete_table(table), *widths);
}

Answer run_g_theory(const DataTable& table, const ProcedureOptions& options) {
  const std::optional<double> target = options.number("phi", 0.8);
  if (!target || !(*target > 0.0) || !(*target < 1.0)) return bad_option("g_theory", "phi", table);
  return g_theory(table, *target);
}

std::size_t decimals_of(const std::string& number) {
  const std::size_t point = number.find('.');
  if (point == std::string::npos) return 0;
  return number.find_first_not_of("0123456789", point + 1) == std::string::npos ? number.size() - point - 1 : 9;
}

// A number as printed, within what sums of squares hold, with its decimals. `bad`: the option that is not what it
// takes.
double printed(const ProcedureOptions& options, const char* name, const char* decimals_name, std::size_t& decimals,
               const char*& bad) {
  const std::optional<double> value = options.number(name, 0.0);
  const std::size_t typed = decimals_of(options.text(name));
  const auto digits = options.whole(decimals_name, typed, 0, 8);
  if (!options.has(name) || !value || std::abs(*value) > 1e4 || typed > 8)
    bad = name;
  else if (!digits)
    bad = decimals_name;
  else
    decimals = *digits;
  return value.value_or(0.0);
}

// `bad`: the option that is not what it takes.
ReportedScale reported_in(const ProcedureOptions& options, bool with_sd, const char*& bad) {
  ReportedScale reported;
  const auto n = options.whole("n", 0, 1, 100000), items = options.whole("items", 1, 1, 100);
  reported.mean = printed(options, "mean", "decimals", reported.mean_decimals, bad);
  if (with_sd) reported.sd = printed(options, "sd", "sd_decimals", reported.sd_decimals, bad);
  if (!n || *n == 0) bad = "n";
  if (!items) bad = "items";
  if (reported.sd && *reported.sd < 0.0) bad = "sd";
  for (const char* name : {"low", "high"}) {
    if (!options.has(name)) continue;
    const std::optional<double> end = options.number(name, 0.0);
    if (!end || std::floor(*end) != *end || std::abs(*end) > 1e4) bad = name;
    (std::string(name) == "low" ? reported.low : reported.high) = end;
  }
  if (bad == nullptr && reported.low && reported.high && *reported.low >= *reported.high) bad = "high";
  if (bad != nullptr) return reported;
  reported.n = *n;
  reported.items = *items;
  return reported;
}

Answer run_grim(const DataTable& table, const ProcedureOptions& options) {
  const char* bad = nullptr;
  const ReportedScale reported = reported_in(options, false, bad);
  return bad != nullptr ? bad_option("grim", bad, table) : grim(reported);
}

Answer run_grimmer(const DataTable& table, const ProcedureOptions& options) {
  const char* bad = nullptr;
  const ReportedScale reported = reported_in(options, true, bad);
  if (bad != nullptr) return bad_option("grimmer", bad, table);
  if (reported.n < 2) return not_estimable("grimmer", "too_few", reported.n);
  return grimmer(reported);
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
    {"bland_altman", "How far two methods or two raters differ on the same subjects, in their own unit.",
     "two columns of values, a row a subject; or value by subject and rater, two raters", kTwoColumns,
     kBlandAltmanOptions, run_bland_altman, "Bland, Altman, Lancet 1986;1:307",
     "the paper's peak flows, R's t.test and lm, 1e-9"},
    {"g_theory", "Where the variance of scores comes from, and how many cases a decision about a person needs.",
     "value by subject (the person) and rater (the case), and by x (the occasion) where there are several; "
     "balanced",
     kPersonsByCases, kGTheoryOptions, run_g_theory, "Brennan, Generalizability Theory, 2001",
     "Shrout and Fleiss's table and R's aov, 1e-9"},
    {"grim", "Whether a reported mean can come from so many whole numbers.", "no data: the options say everything",
     kNothing, kGrimOptions, run_grim, "Brown, Heathers, Soc Psychol Pers Sci 2017;8:363", "enumeration, equal"},
    {"grimmer", "Whether a reported mean and standard deviation can come from so many whole numbers.",
     "no data: the options say everything", kNothing, kGrimmerOptions, run_grimmer,
     "Anaya, PeerJ Preprints 2016;4:e2400v1", "enumeration, equal"},
};

}  // namespace

std::span<const Procedure> reliability_procedures() {
  return kReliability;
}

}  // namespace seldinger::assessment::statistics
