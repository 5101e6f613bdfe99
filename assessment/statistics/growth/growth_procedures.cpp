#include "assessment/statistics/growth/growth_procedures.h"

#include <cmath>
#include <string>

#include "assessment/statistics/growth/cusum_chart.h"
#include "assessment/statistics/growth/decay.h"
#include "assessment/statistics/growth/learning_curve.h"
#include "assessment/statistics/growth/mixed_model.h"
#include "assessment/statistics/growth/proficiency.h"
#include "assessment/statistics/growth/rasch/rasch.h"

namespace seldinger::assessment::statistics {
namespace {

Answer bad_option(const char* test, const DataTable& table, const char* why) {
  Answer answer = not_estimable(test, "bad_value", table.rows);
  answer.notes.emplace_back(why);
  return answer;
}

constexpr double kNoNumber = -1.0;  // what every rule refuses

bool set_rule(const ProcedureOptions& options, CusumRule& rule) {
  rule.adequate = options.number("adequate", rule.adequate).value_or(kNoNumber);
  rule.inadequate = options.number("inadequate", rule.inadequate).value_or(kNoNumber);
  rule.permitted = options.number("permitted", rule.permitted).value_or(kNoNumber);
  const double attempts = options.number("attempts", static_cast<double>(rule.attempts)).value_or(kNoNumber);
  const bool whole = attempts >= 1.0 && attempts <= 1e6 && attempts == std::floor(attempts);
  if (whole) rule.attempts = static_cast<std::size_t>(attempts);
  return whole && sound(rule);
}

constexpr const char* kRuleWords =
    "options adequate, inadequate, permitted and attempts: 0 < adequate < inadequate < 1, 0 < permitted < 1, "
    "1 to 2000 attempts";

Answer run_lc_cusum(const DataTable& table, const ProcedureOptions& options) {
  CusumRule rule;
  if (!set_rule(options, rule)) return bad_option("lc_cusum", table, kRuleWords);
  return lc_cusum(table, rule);
}

// Any of its options makes it a chart of values of any size.
bool of_any_values(const ProcedureOptions& options) {
  for (const char* name : {"target", "sd", "shift", "run_length", "worse"})
    if (options.has(name)) return true;
  return false;
}

Answer run_cusum(const DataTable& table, const ProcedureOptions& options) {
  if (of_any_values(options)) {
    NormalCusumRule rule;
    const auto target = options.number("target", 0.0);
    rule.target = target.value_or(0.0);
    rule.sd = options.number("sd", 1.0).value_or(kNoNumber);
    rule.shift = options.number("shift", rule.shift).value_or(kNoNumber);
    rule.run_length = options.number("run_length", rule.run_length).value_or(kNoNumber);
    const std::string worse = options.text("worse", "higher");
    rule.lower_is_worse = worse == "lower";
    if (!target || !sound(rule) || (worse != "lower" && worse != "higher"))
      return bad_option(
          "cusum", table,
          "options target, sd, shift, run_length and worse: sd above 0, shift 0.1 to 5, run_length 10 "
          "to 100000, worse higher or lower");
    return cusum(table, rule);
  }
  CusumRule rule;
  if (!set_rule(options, rule)) return bad_option("cusum", table, kRuleWords);
  return cusum(table, rule);
}

Answer run_learning_curve(const DataTable& table, const ProcedureOptions& options) {
  LearningCurveOptions how;
  const std::string better = options.text("better", "lower");
  how.higher_is_better = better == "higher";
  how.closed = options.number("closed", how.closed).value_or(kNoNumber);
  if (!(how.closed > 0.0 && how.closed < 1.0) || (better != "lower" && better != "higher"))
    return bad_option("learning_curve", table, "options better and closed: better lower or higher, 0 < closed < 1");
  return learning_curve(table, how);
}

Answer run_mixed_model(const DataTable& table, const ProcedureOptions& options) {
  const std::string random = options.text("random", "auto"), interaction = options.text("interaction", "no");
  MixedModelOptions how;
  how.interaction = interaction == "yes";
  if (random == "intercept") how.random = RandomEffects::intercept;
  if (random == "slope") how.random = RandomEffects::slope;
  const bool known = random == "auto" || random == "intercept" || random == "slope";
  if (!known || (interaction != "yes" && interaction != "no"))
    return bad_option("mixed_model", table,
                      "options random and interaction: random auto, intercept or slope, interaction yes or no");
  return mixed_model(table, how);
}

Answer run_logistic_mixed(const DataTable& table, const ProcedureOptions& options) {
  LogisticMixedOptions how;
  const std::string interaction = options.text("interaction", "no");
  how.interaction = interaction == "yes";
  const double nodes = options.number("nodes", static_cast<double>(how.nodes)).value_or(kNoNumber);
  if (!(nodes >= 15.0 && nodes <= 101.0 && nodes == std::floor(nodes)) ||
      (interaction != "yes" && interaction != "no"))
    return bad_option("logistic_mixed", table,
                      "options nodes and interaction: nodes 15 to 101, interaction yes or no");
  how.nodes = static_cast<std::size_t>(nodes);
  return logistic_mixed(table, how);
}

Answer run_rasch(const DataTable& table, const ProcedureOptions&) {
  return rasch(table);
}

Answer run_proficiency(const DataTable& table, const ProcedureOptions& options) {
  ProficiencyRule rule;
  rule.share = options.number("share", rule.share).value_or(kNoNumber);
  rule.sure = options.number("sure", rule.sure).value_or(kNoNumber);
  const auto last = options.whole("last", rule.last, 1, 1000);
  if (!last || !sound(rule))
    return bad_option("proficiency", table, "options share, sure and last: shares between 0 and 1, last 1 to 1000");
  rule.last = *last;
  return proficiency(table, rule);
}

Answer run_decay(const DataTable& table, const ProcedureOptions& options) {
  DecayOptions how;
  const std::string better = options.text("better", "lower");
  how.higher_is_better = better == "higher";
  how.pause = options.number("pause", how.pause).value_or(kNoNumber);
  if (!(how.pause > 0.0) || (better != "lower" && better != "higher"))
    return bad_option("decay", table, "options pause and better: pause above 0, better lower or higher");
  return decay(table, how);
}

constexpr ProcedureOption kDecayOptions[] = {
    {"pause", "a number above 0, 1 unless given", "the least difference of x that is a pause"},
    {"better", "lower or higher", "which values are better; lower unless given"},
};
constexpr ProcedureOption kLcCusumOptions[] = {
    {"adequate", "a share, 0.10 unless given", "rate of failure of those who are competent"},
    {"inadequate", "a share, 0.30 unless given", "rate of failure of those who are not"},
    {"attempts", "1 to 2000, 50 unless given", "the attempts over which the error is controlled"},
    {"permitted", "a share, 0.10 unless given", "how many of the inadequate may be declared competent"},
};
constexpr ProcedureOption kCusumOptions[] = {
    {"adequate", "a share, 0.10 unless given", "rate of failure that is accepted"},
    {"inadequate", "a share, 0.30 unless given", "rate of failure that is to be found"},
    {"attempts", "1 to 2000, 50 unless given", "the attempts over which the error is controlled"},
    {"permitted", "a share, 0.10 unless given", "how many of the adequate may have an alarm"},
    {"target", "a number", "makes it a chart of values of any size: their mean while all is well"},
    {"sd", "a number above 0, 1 unless given", "their standard deviation then"},
    {"shift", "0.1 to 5, 1 unless given", "the change that is to be found, in SDs"},
    {"run_length", "10 to 100000, 500 unless given", "attempts until a false alarm, on average"},
    {"worse", "higher or lower", "the side on which values are worse; higher unless given"},
};
constexpr ProcedureOption kProficiencyOptions[] = {
    {"share", "a share, 0.8 unless given", "of attempts that a proficient person passes, or more"},
    {"sure", "a share, 0.9 unless given", "the probability from which on somebody counts as proficient"},
    {"last", "1 to 1000, 10 unless given", "how many of the last attempts count"},
};
constexpr ProcedureOption kLearningCurveOptions[] = {
    {"better", "lower or higher", "whether practice makes values fall or rise; lower unless given"},
    {"closed", "a share, 0.9 unless given", "of the way to the plateau that counts as having arrived"},
};

constexpr ProcedureOption kMixedModelOptions[] = {
    {"random", "auto, intercept or slope",
     "what differs between persons; auto: also the slope, from four occasions"},
    {"interaction", "yes or no", "a slope of x for each group; no unless given"},
};

constexpr ProcedureOption kLogisticMixedOptions[] = {
    {"nodes", "15 to 101, 25 unless given", "of the quadrature"},
    {"interaction", "yes or no", "a slope of x for each group; no unless given"},
};

constexpr Needs kRepeated{.subject = true};
constexpr Needs kScores{.most_values = 200};

constexpr Procedure kProcedures[] = {
    {"lc_cusum",
     "Whether a learner may be called competent, from failures in order.",
     "value: 1 failure, 0 success, in order of x or of the rows; subject: a chart for each",
     {},
     kLcCusumOptions,
     &run_lc_cusum,
     "Biau et al. 2010; limit by enumeration",
     "exact probabilities of published settings, 1e-6; 100,000 simulated learners within 3 SE"},
    {"cusum",
     "Whether somebody who was competent no longer is, from failures or from values in order.",
     "value: 1 failure, 0 success (with option target: any number), in order; subject: a chart for each",
     {},
     kCusumOptions,
     &run_cusum,
     "Page 1954; limit by enumeration, for values of any size by quadrature of the run length",
     "R spc (xcusum.arl, xcusum.crit) 1e-6; 100,000 simulated charts within 3 SE"},
    {"proficiency",
     "Whether a learner now passes as often as is asked, as a probability.",
     "value: 1 passed, 0 not, in order of x or of the rows; subject: a row for each",
     {},
     kProficiencyOptions,
     &run_proficiency,
     "beta posterior with Jeffreys' prior (Brown, Cai, DasGupta 2001)",
     "R pbeta, qbeta 1e-9; two running by enumeration of all sequences"},
    {"learning_curve",
     "How fast a value changes with practice, and where it levels off.",
     "value; x: number or time of the attempt, else the order of the rows; subject: a curve for each",
     {},
     kLearningCurveOptions,
     &run_learning_curve,
     "power law of practice (Newell and Rosenbloom 1981), exponential (Heathcote et al. 2000), AICc",
     "R nls 1e-6"},
    {"decay", "What is lost over a pause, and how much more over a longer one.", "value; subject; x: when, in days",
     Needs{.subject = true, .x = true}, kDecayOptions, &run_decay,
     "Arthur et al., Hum Perform 1998;11:57, as a paired comparison", "R t.test and lm, 1e-9"},
    {"mixed_model", "How values of repeated persons change with x and differ between groups.",
     "value; subject: at least two persons with several values; x; group", kRepeated, kMixedModelOptions,
     &run_mixed_model, "REML as in Bates et al. 2015; df of Satterthwaite after Giesbrecht and Burns 1985",
     "R lme4 and lmerTest: criterion 1e-6, fixed effects 1e-5, variance components 1e-3"},
    {"logistic_mixed", "How the odds of passing change with x and differ between groups, for repeated persons.",
     "value: 1 passed, 0 not; subject: at least two persons with several values; x; group", kRepeated,
     kLogisticMixedOptions, &run_logistic_mixed,
     "random intercept, adaptive Gauss–Hermite quadrature (Pinheiro and Bates 1995)",
     "R lme4 (glmer, nAGQ): fixed effects 1e-4, SD 1e-3"},
    {"rasch",
     "Difficulty of items, severity of raters and ability of persons on one scale, for a Wright map.",
     "value: a column for each item (or one, with group: the item), scores from 0; subject; rater",
     kScores,
     {},
     &run_rasch,
     "Rasch, rating scale and many-facet models by conditional likelihood (Andersen 1970, Fischer and Ponocny "
     "1994)",
     "R eRm (RM, RSM, LLTM, LPCM): places 1e-4, infit and outfit 1e-3"},
};

}  // namespace

std::span<const Procedure> growth_procedures() {
  return kProcedures;
}

}  // namespace seldinger::assessment::statistics
