// The plan of a study: what its numbers are to be used for, who is compared with whom by which test, and what is
// done about what is missing; said before anybody looks. A plan is read whole or refused with all that is wrong
// with it, and has one canonical text, whose hash a freeze keeps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "assessment/grading/rule.h"
#include "assessment/metrics/metric.h"
#include "sim/base/names.h"
#include "sim/base/result.h"
#include "sim/case/case.h"

namespace seldinger::assessment::study {

// Kane's inferences (2013), from what was seen to what is decided.
enum class Inference { scoring, generalisation, extrapolation, implications };
inline constexpr auto kInferenceNames = base::names<Inference>({{Inference::scoring, "scoring"},
                                                                {Inference::generalisation, "generalisation"},
                                                                {Inference::extrapolation, "extrapolation"},
                                                                {Inference::implications, "implications"}});
struct Claim {
  Inference inference = Inference::scoring;
  std::string claim;
  std::string evidence;                // what speaks for it beside this study; empty: none yet
  std::vector<std::string> rebuttals;  // what would undo it
};

// What a person said of themselves: a number with <=, >= or =, or a word with =.
struct FactCriterion {
  std::string fact;
  Comparison comparison = Comparison::equal;
  std::string value;
};
struct PlannedGroup {
  std::string name;
  std::vector<FactCriterion> facts;  // all of them must hold; of an arm none
  int ratio = 1;                     // of an arm: its places in a block
};

// Days since the person was enrolled; before it negative.
struct Visit {
  std::string name;
  double from_day = 0.0, to_day = 0.0;
};

enum class Test { welch, brunner_munzel, mann_whitney };
inline constexpr auto kTestNames = base::names<Test>(
    {{Test::welch, "welch"}, {Test::brunner_munzel, "brunner_munzel"}, {Test::mann_whitney, "mann_whitney"}});
struct Outcome {
  std::string name, metric;
  int version = 1;  // of the metric's definition
  std::string case_id, visit;
  Test test = Test::welch;
  std::string first, second;  // the groups that are compared
  Direction better = Direction::lower_is_better;
  double smallest_worthwhile = 0.0;  // in the metric's unit
  // What a person who failed counts as in a difference of means, in the metric's unit; a test of order ranks
  // failures last and needs none.
  std::optional<double> failure_value;
  // Another outcome of the plan, by name, that goes with this one: what absent people are imputed from.
  std::string impute_from{};
};

enum class People { real, simulated };  // whose attempts
inline constexpr auto kPeopleNames =
    base::names<People>({{People::real, "real"}, {People::simulated, "simulated"}});
// What leads the needle: more than one kind makes the outcome not analysed, or each a comparison of its own.
enum class Hands { one, stratified };
inline constexpr auto kHandsNames = base::names<Hands>({{Hands::one, "one"}, {Hands::stratified, "stratified"}});
// Who has no attempt at an outcome: left out, or counted as a failure.
enum class Absent { left_out, failure };
inline constexpr auto kAbsentNames =
    base::names<Absent>({{Absent::left_out, "left_out"}, {Absent::failure, "failure"}});

// An attempt is left out whose metric of the recording is so: what a recording is worth, never what was achieved.
struct Exclusion {
  std::string metric;
  Comparison comparison = Comparison::at_least;
  double value = 0.0;
  std::string why;
};

struct Randomisation {
  std::vector<std::string> strata;  // facts whose answers part the sequences
  std::vector<int> block_sizes;     // drawn among
};

struct Plan {
  std::string title, intended_use, decision;
  People people = People::real;
  std::vector<Claim> argument;  // one for each inference, in their order
  std::vector<PlannedGroup> groups;
  bool randomised = false;  // the groups are arms
  Randomisation randomisation;
  std::vector<Visit> visits;
  std::vector<Outcome> primary, secondary;
  int per_group = 0;  // persons with an outcome, at which the study stops
  std::string stopping_rule;
  Absent absent = Absent::left_out;
  std::string missing_why;
  int imputations = 0;  // draws of absent people's values, of primary outcomes by `welch`; 0: none are drawn
  std::vector<Exclusion> exclusions;
  Hands hands = Hands::one;
  double alpha = 0.05;  // of all primary outcomes together
};

inline constexpr std::size_t kMostPrimary = 3, kMostGroups = 8;
inline constexpr int kLeastImputations = 10, kMostImputations = 500;

// `bad_study_plan`, each problem a finding that names its place ("primary[0].compare"). Of form alone: what was
// frozen is read whatever became of its metrics.
base::Result<Plan> plan_from_json(const std::string& text);
// What is wrong with a plan by the metrics of today, in the same words; asked of drafts. `laws`: by which law of
// sight its cases' pictures are told; of others the newest.
std::vector<base::Problem> problems_of(const Plan& plan, const std::map<std::string, cases::SightLaw>& laws = {});
// Words that the template asks its reader to replace; a draft may have them, and what is frozen may not.
inline constexpr std::string_view kToReplace = "REPLACE";
std::vector<base::Problem> unanswered_in(const Plan& plan);
// Whether somebody can have failed at it instead of having a value.
bool can_fail(const MetricInfo& info) noexcept;
// Keys in their order, digits as short as they read back, no blanks: the same for every text of the same plan, and
// read back the same.
std::string canonical_json(const Plan& plan);

const PlannedGroup* find_group(const Plan& plan, std::string_view name);
const Visit* find_visit(const Plan& plan, std::string_view name);

// The facts that a person's group or stratum depends on, each once.
std::vector<std::string> facts_of(const Plan& plan);

// Whether an answer fits; a number is compared as a number.
bool fits(const FactCriterion& criterion, std::string_view answer);

}  // namespace seldinger::assessment::study
