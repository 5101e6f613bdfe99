// An outcome beside what else is known of the same people: what raters made of them, and the experience that they
// stated. Spearman's ρ, as it is and corrected for what either side's own unreliability hides (Spearman 1904).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "assessment/study/analysis.h"
#include "casedb/people/facts.h"
#include "casedb/ratings/rated_people.h"
#include "casedb/studies/study_data.h"

namespace seldinger::reports {

// How far a side's values would come out alike a second time; nothing, and why.
struct Reliability {
  std::optional<double> value;
  std::string why_not;
};

// Of persons' values on the outcome: each person's attempts in two halves, every other one, their means' rank
// correlation stepped up to all attempts (Spearman and Brown, 1910).
Reliability value_reliability(const assessment::study::Compared& outcome);
// The halves' means of a person with two attempts.
std::optional<std::pair<double, double>> halves_of(const assessment::study::PersonValue& person);
// Of the mean of a replay's ratings: ICC(1,k). A person's mean over several replays is
// taken to be as reliable as that of one, which is careful only where replays of a person are alike.
Reliability rating_reliability(const casedb::RatedPeople& rated);

struct Other {
  std::string name, detail;             // "Years in radiology", "as stated at the enrolment"
  std::map<std::string, double> value;  // by pseudonym
  Reliability reliability;
};
// What people stated to one, where it is a number; by pseudonym.
std::map<std::string, double> stated_of(const casedb::FactInfo& fact,
                                        const std::map<std::string, casedb::Background>& people);
// Each fact that is a number and that somebody stated, in the order of facts.h.
std::vector<Other> stated_experience(const std::map<std::string, casedb::Background>& people);
Other mean_rating(const casedb::RatedPeople& rated);

struct Related {
  assessment::statistics::DataTable table;  // the first column: the outcome; x: the other
  assessment::statistics::Answer raw;
  std::optional<double> corrected;
  std::optional<assessment::statistics::Interval> corrected_ci95;
  std::string why_not_corrected;
};
// Of who has both; who failed has no value.
Related related(const assessment::study::Compared& outcome, const Other& other, const Reliability& of_outcome);

}  // namespace seldinger::reports
