// The planned comparisons, done: persons' attempts become one value a person by the metric's estimand, who failed
// ranks last, and the test is the one that the plan names. What is not of the plan is not here.
#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "assessment/estimand.h"
#include "assessment/statistics/answer.h"
#include "assessment/study/plan.h"

namespace seldinger::assessment::study {

struct StudyAttempt {
  std::string case_id;
  double day = 0.0;                  // since the person was enrolled
  bool synthetic = false;            // by a simulated operator
  std::string cut_off;               // how it ended through no decision of who made it; empty: it did not
  std::string hand;                  // what led the needle; empty: not known
  std::string arm{};                 // the arm's model; empty: none led it, or it is not known
  std::vector<MetricValue> metrics;  // every version that is stored
  bool too_late = false;             // begun after the data were locked
};
struct StudyPerson {
  std::string name;   // a pseudonym
  std::string group;  // empty: none of the plan's
  std::vector<StudyAttempt> attempts;
};

// Why an attempt is no part of an outcome.
struct LeftOut {
  std::string why;
  std::size_t attempts = 0;
};

enum class Standing { value, failure, censored, absent };  // absent: no attempt counts
struct PersonValue {
  std::string name, group;
  Standing standing = Standing::absent;
  double value = 0.0;  // of Standing::value
  std::size_t attempts = 0;
  std::vector<double> values{};  // of the attempts that count and have one, oldest first
  bool every_visit = true;       // came to each of the plan's; told by add_sensitivity
  // Of the attempts that count, each once, by name.
  std::set<std::string> hands{}, arms{};
};

struct GroupSum {
  std::string name;
  std::size_t persons = 0, with_value = 0, failures = 0, censored = 0, absent = 0, attempts = 0;
  std::optional<double> median, low_quartile, high_quartile;  // of those who have a value
};

// The same comparison under another rule for what is missing, or of those alone who kept to the plan.
enum class OtherRule { present, best_in_first, worst_in_first, per_protocol, tipping, imputed };
inline constexpr auto kOtherRuleNames = base::names<OtherRule>({{OtherRule::present, "present"},
                                                                {OtherRule::best_in_first, "best_in_first"},
                                                                {OtherRule::worst_in_first, "worst_in_first"},
                                                                {OtherRule::per_protocol, "per_protocol"},
                                                                {OtherRule::tipping, "tipping"},
                                                                {OtherRule::imputed, "imputed"}});
struct Sensitivity {
  OtherRule kind = OtherRule::present;
  std::string rule;  // in words
  statistics::Answer answer;
  std::optional<double> shift{};  // of tipping, in the metric's unit
  // Of imputed: by draw, values of those of `people` who are absent, the first group's before the second's.
  std::vector<std::vector<double>> draws{};
};

struct Compared {
  Outcome outcome;
  std::string hand;                 // of a comparison within one kind of hand; empty: of all
  std::string refused;              // why it is not analysed, in words; empty: it is
  std::vector<PersonValue> people;  // of both groups
  GroupSum first, second;
  std::vector<LeftOut> left_out;
  std::vector<std::string> hands;  // of the attempts that count
  statistics::Answer answer;
  std::optional<double> p_adjusted;  // by Holm, of a primary outcome
  std::vector<Sensitivity> sensitivity;
};

struct StudyResult {
  std::vector<Compared> primary, secondary;
  bool stopped = false;  // every primary outcome has the planned number of persons in each group
};

// Each person in the group that they were enrolled in, whatever they did.
StudyResult analyse(const Plan& plan, const std::vector<StudyPerson>& people);

// Beside the rules that `analyse` tells: per protocol, where somebody who is analysed missed a visit; and of a
// significant primary outcome with absent people the tipping point. There the absent stand at their group's median,
// those of the better group shifted for the worse and those of the other for the better, by the least shift at
// which p is no longer below alpha (a twentieth of the values' range at a time, then halved), or by the whole
// range. Last, where the plan asks for it, absent people's values by multiple imputation.
void add_sensitivity(const Plan& plan, const std::vector<StudyPerson>& people, StudyResult& result);

// What each person has on an outcome, without regard to groups.
struct Collected {
  std::vector<PersonValue> people;
  std::vector<LeftOut> left_out;
  std::vector<std::string> hands;
  std::size_t other_versions = 0;  // attempts with the metric in another version only
};
// `hand` empty: all.
Collected collect(const Plan& plan, const Outcome& outcome, const std::vector<StudyPerson>& people,
                  const std::string& hand);

// Holm's step-down (Scand. J. Statist. 6, 1979); what has no p is no member of the family's tests, but counts in
// its size.
std::vector<std::optional<double>> holm_adjusted(const std::vector<std::optional<double>>& p);

}  // namespace seldinger::assessment::study
