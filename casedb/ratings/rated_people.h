// What raters made of a study's people: for the report, beside what was measured.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "casedb/ratings/rating_rounds.h"

namespace seldinger::casedb {

// By one version of one form, at one case. Another version is another entry: they are never pooled.
struct RatedPeople {
  std::string form_id, form_title;
  int version = 1;
  std::string case_id;
  std::size_t ratings = 0;             // without calibration and repeats, with a mean
  std::map<std::string, double> mean;  // by pseudonym: of the person's replays, each the mean of its ratings
  std::vector<assessment::rating::Rating> scores{};  // without calibration and repeats: what agreement is of
  std::size_t each = 0;                              // the fewest that a round gives a replay
};
std::vector<RatedPeople> rated_people(Library& library, const std::string& study_id);

// How far raters of a round agree on the mean of its form.
struct RatedRound {
  std::string form_title, round_title;
  int version = 1;
  assessment::rating::Agreement agreement;
  std::vector<assessment::rating::Rating> scores{};  // what agreement is of
  std::size_t each = 0;                              // ratings that a replay gets
};
// Of the study, the oldest first; those in which nothing was sent are left out.
std::vector<RatedRound> rated_rounds(Library& library, const std::string& study_id);

}  // namespace seldinger::casedb
