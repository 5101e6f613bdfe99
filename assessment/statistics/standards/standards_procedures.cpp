#include "assessment/statistics/standards/standards_procedures.h"

#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "assessment/statistics/spread.h"
#include "assessment/statistics/standards/angoff.h"
#include "assessment/statistics/standards/borderline.h"
#include "assessment/statistics/standards/classification.h"
#include "assessment/statistics/standards/contrasting_groups.h"
#include "assessment/statistics/standards/hofstee.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr ProcedureOption kDirection = {"direction", "higher, lower",
                                        "which scores are better; higher unless given"};
constexpr ProcedureOption kDraws = {"resamples", "a whole number up to 100000",
                                    "draws of persons for the interval; 2000 unless given, 0 for none"};
constexpr ProcedureOption kSeed = {"seed", "a whole number", "what the draws are made from; 1 unless given"};

constexpr ProcedureOption kContrastingOptions[] = {
    {"competent", "a group's name", "the group that has the competence; unless given, the one that scores better"},
    kDirection,
    kDraws,
    kSeed,
};
constexpr ProcedureOption kBorderlineOptions[] = {
    {"borderline", "a number", "the rating that is borderline; 2 unless given"},
    {"method", "regression, group", "which cut is the answer; regression unless given"},
    kDraws,
    kSeed,
};
constexpr ProcedureOption kAngoffOptions[] = {
    {"scale", "a number above 0",
     "what the judges write for certainty: 1 for shares (unless given), 100 for per cent"},
};
constexpr ProcedureOption kHofsteeOptions[] = {
    {"cut_low", "numbers, with : between judges", "the least cut that is accepted"},
    {"cut_high", "numbers, with : between judges", "the highest cut that is accepted"},
    {"fail_low", "shares, with : between judges", "the least share of failing that is accepted"},
    {"fail_high", "shares, with : between judges", "the highest share of failing that is accepted"},
    kDirection,
    kDraws,
    kSeed,
};
constexpr ProcedureOption kClassificationOptions[] = {
    {"cut", "a number", "the cut; that score itself passes"},
    {"reliability", "a number between 0 and 1", "of the scores: alpha, Phi, an ICC"},
    {"low", "a number", "the scale's lower end; with high it is Livingston and Lewis' way, for scores with ends"},
    {"high", "a number", "the scale's upper end"},
    kDirection,
};

Answer bad_option(const char* test, const char* name, const DataTable& table) {
  Answer answer = not_estimable(test, "bad_value", table.rows);
  answer.notes.push_back(std::string("The option ") + name + " is missing or not what it takes.");
  return answer;
}

// What several standards ask; `bad` names the option that is not what it takes.
struct DrawOptions {
  bool higher_is_better = true;
  std::size_t draws = 0, seed = 0;
  const char* bad = nullptr;
};

DrawOptions draw_options(const ProcedureOptions& options) {
  DrawOptions found;
  const std::string direction = options.text("direction", "higher");
  const auto draws = options.whole("resamples", 2000, 0, 100000), seed = options.whole("seed", 1, 0, 4294967295);
  if (!draws) found.bad = "resamples";
  if (!seed) found.bad = "seed";
  if (direction != "higher" && direction != "lower") found.bad = "direction";
  if (found.bad != nullptr) return found;
  found.higher_is_better = direction == "higher";
  found.draws = *draws;
  found.seed = *seed;
  return found;
}

// Each person's score, and x where it is asked for.
struct PersonScores {
  std::vector<double> scores, x;
  std::size_t missing = 0;
  const char* reason = nullptr;
};

PersonScores person_scores(const DataTable& table, bool with_x) {
  PersonScores found;
  std::set<std::string> seen;
  for (std::size_t i = 0; i < table.rows; ++i) {
    const double score = table.values.front().values[i];
    const bool nobody = !table.subject.empty() && table.subject[i].empty();
    if (std::isnan(score) || nobody || (with_x && std::isnan(table.x[i]))) {
      ++found.missing;
      continue;
    }
    if (!table.subject.empty() && !seen.insert(table.subject[i]).second) found.reason = "repeated_subject";
    found.scores.push_back(score);
    if (with_x) found.x.push_back(table.x[i]);
  }
  if (found.reason == nullptr && found.scores.empty()) found.reason = "no_data";
  return found;
}

Answer refused_persons(const char* test, const PersonScores& persons) {
  Answer answer = not_estimable(test, persons.reason, persons.scores.size());
  answer.missing = persons.missing;
  return answer;
}

Answer refused_pair(const char* reason, const IndependentGroups& found) {
  Answer answer = not_estimable("contrasting_groups", reason, found.n, found.counts());
  answer.missing = found.missing;
  return answer;
}

Answer run_contrasting_groups(const DataTable& table, const ProcedureOptions& options) {
  const DrawOptions draw = draw_options(options);
  if (draw.bad != nullptr) return bad_option("contrasting_groups", draw.bad, table);
  IndependentGroups found = independent_groups(table);
  if (found.reason != nullptr) return refused_pair(found.reason, found);
  if (found.groups.size() != 2)
    return refused_pair(found.groups.empty()       ? "no_data"
                        : found.groups.size() == 1 ? "one_group"
                                                   : "not_two_groups",
                        found);
  std::size_t competent = 0;
  const bool named = options.has("competent");
  if (named) {
    const std::string name = options.text("competent");
    if (name != found.groups[0].name && name != found.groups[1].name)
      return bad_option("contrasting_groups", "competent", table);
    competent = name == found.groups[0].name ? 0 : 1;
  } else {
    const double first = spread_of(found.groups[0].values).mean, second = spread_of(found.groups[1].values).mean;
    competent = (first > second) == draw.higher_is_better ? 0 : 1;
  }
  Group &with = found.groups[competent], &without = found.groups[1 - competent];
  ContrastingGroups groups{{without.name, without.values.size()},
                           {with.name, with.values.size()},
                           without.values,
                           with.values,
                           draw.higher_is_better,
                           found.missing};
  Answer answer = contrasting_groups(groups, draw.draws, draw.seed);
  if (!named) answer.notes.push_back(with.name + " scores better and was taken for the competent group.");
  return answer;
}

Answer run_borderline(const DataTable& table, const ProcedureOptions& options) {
  const DrawOptions draw = draw_options(options);
  if (draw.bad != nullptr) return bad_option("borderline", draw.bad, table);
  const std::optional<double> rating = options.number("borderline", 2.0);
  if (!rating) return bad_option("borderline", "borderline", table);
  const std::string method = options.text("method", "regression");
  if (method != "regression" && method != "group") return bad_option("borderline", "method", table);
  PersonScores persons = person_scores(table, true);
  if (persons.reason != nullptr) return refused_persons("borderline", persons);
  return borderline({std::move(persons.scores), std::move(persons.x), persons.missing, *rating},
                    method == "group" ? BorderlineMethod::kGroup : BorderlineMethod::kRegression, draw.draws,
                    draw.seed);
}

// The rows of each round, in rising order; all of them are one round where no x is given. Rows without a number of
// their round belong to none.
std::vector<AngoffRound> rounds_of(const DataTable& table, double scale) {
  std::map<double, DataTable> by_round;
  for (std::size_t i = 0; i < table.rows; ++i) {
    const double number = table.x.empty() ? 1.0 : table.x[i];
    if (!std::isfinite(number) || std::abs(number) > 1e6) continue;
    DataTable& round = by_round[number];
    if (round.values.empty()) round.values.push_back({table.values.front().name, {}});
    round.values.front().values.push_back(table.values.front().values[i] / scale);
    round.subject.push_back(table.subject[i]);
    round.rater.push_back(table.rater[i]);
    ++round.rows;
  }
  std::vector<AngoffRound> rounds;
  for (const auto& [number, round] : by_round) rounds.push_back({number, complete_table(round)});
  return rounds;
}

Answer run_angoff(const DataTable& table, const ProcedureOptions& options) {
  const std::optional<double> scale = options.number("scale", 1.0);
  if (!scale || !(*scale > 0.0)) return bad_option("angoff", "scale", table);
  return angoff(rounds_of(table, *scale));
}

// Nothing: something in the list is no finite number.
std::optional<std::vector<double>> numbers_in(const ProcedureOptions& options, const char* name) {
  std::vector<double> numbers;
  for (const std::string& text : options.list(name)) {
    const std::optional<double> one = ProcedureOptions({{name, text}}).number(name, 0.0);
    if (!one || std::abs(*one) > 1e100) return std::nullopt;
    numbers.push_back(*one);
  }
  if (numbers.empty()) return std::nullopt;
  return numbers;
}

Answer run_hofstee(const DataTable& table, const ProcedureOptions& options) {
  const DrawOptions draw = draw_options(options);
  if (draw.bad != nullptr) return bad_option("hofstee", draw.bad, table);
  HofsteeLimits limits;
  const std::pair<const char*, std::vector<double>*> all[] = {{"cut_low", &limits.cut_low},
                                                              {"cut_high", &limits.cut_high},
                                                              {"fail_low", &limits.fail_low},
                                                              {"fail_high", &limits.fail_high}};
  for (const auto& [name, into] : all) {
    const auto numbers = numbers_in(options, name);
    if (!numbers) return bad_option("hofstee", name, table);
    *into = *numbers;
  }
  PersonScores persons = person_scores(table, false);
  if (persons.reason != nullptr) return refused_persons("hofstee", persons);
  return hofstee(std::move(persons.scores), persons.missing, limits, draw.higher_is_better, draw.draws, draw.seed);
}

Answer run_classification(const DataTable& table, const ProcedureOptions& options) {
  const DrawOptions draw = draw_options(options);
  if (draw.bad != nullptr) return bad_option("classification", draw.bad, table);
  const std::optional<double> cut = options.number("cut", 0.0), reliability = options.number("reliability", 0.0);
  if (!options.has("cut") || !cut) return bad_option("classification", "cut", table);
  if (!reliability || !(*reliability > 0.0) || !(*reliability < 1.0))
    return bad_option("classification", "reliability", table);
  const std::optional<double> low = options.number("low", 0.0), high = options.number("high", 0.0);
  const bool ends = options.has("low") || options.has("high");
  if (!low) return bad_option("classification", "low", table);
  if (!high || (options.has("low") && !(options.has("high") && *high > *low)))
    return bad_option("classification", "high", table);
  if (ends && !options.has("low")) return bad_option("classification", "low", table);
  PersonScores persons = person_scores(table, false);
  if (persons.reason != nullptr) return refused_persons("classification", persons);
  return classification({std::move(persons.scores), persons.missing, *cut, *reliability, draw.higher_is_better,
                         ends ? std::optional(Interval{*low, *high}) : std::nullopt});
}

constexpr Procedure kStandards[] = {
    {"contrasting_groups", "A cut between the scores of persons who have the competence and of persons who do not.",
     "value by group; two groups; subject names the persons", Needs{.group = true}, kContrastingOptions,
     run_contrasting_groups, "Livingston, Zieky, Passing Scores, 1982; Jorgensen et al., Adv Simul 2018;3:5",
     "closed form and R's pnorm, 1e-9"},
    {"borderline", "A cut from scores and a global rating of each person: the score of the borderline person.",
     "value (the score) and x (the rating), a row a person", Needs{.x = true}, kBorderlineOptions, run_borderline,
     "Kramer et al., Med Educ 2003;37:132; Livingston, Zieky, Passing Scores, 1982", "R's lm, 1e-9"},
    {"angoff", "A cut from judges who say how likely somebody who is just good enough is to get each item right.",
     "value (the share) by subject (the item) and rater (the judge), by x (the round) where there are several",
     Needs{.subject = true, .rater = true}, kAngoffOptions, run_angoff,
     "Angoff, in Thorndike, Educational Measurement, 1971; Cizek, Bunch, Standard Setting, 2007",
     "R's t.test, 1e-9"},
    {"hofstee", "A cut within what judges accept, both as a cut and as a share of persons who fail.",
     "value (the score), a row a person; the options hold the judges' limits", Needs{}, kHofsteeOptions,
     run_hofstee, "Hofstee, in Anderson, Helmick, On Educational Testing, 1983", "a search over all cuts, 1e-9"},
    {"classification",
     "How often a second test would decide the same at a cut, and how often the decision is right.",
     "value (the score), a row a person", Needs{}, kClassificationOptions, run_classification,
     "Peng, Subkoviak, J Educ Meas 1980;17:359; Livingston, Lewis, J Educ Meas 1995;32:179",
     "R's integrate, 1e-9; with ends 1e-5"},
};

}  // namespace

std::span<const Procedure> standards_procedures() {
  return kStandards;
}

}  // namespace seldinger::assessment::statistics
