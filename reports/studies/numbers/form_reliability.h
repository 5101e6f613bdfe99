// How far the items of a study's questionnaires hang together, round by round and scale by scale: another version
// is another round, and nothing is pooled over them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "casedb/questionnaires/responses.h"

namespace seldinger::reports {

struct FormReliability {
  std::string form_title, round_title;
  int version = 1;
  std::size_t items = 0;
  int low = 0, high = 0;  // of their scale
  assessment::statistics::Answer alpha, omega;
  assessment::statistics::DataTable answers{};  // what they are of: a row a respondent, a column an item
};

// One for each scale of the round's form on which there are at least two items; each respondent once, without those
// who left one of them out. Items that run against it are mirrored.
std::vector<FormReliability> reliability_of(const casedb::Responses& responses);
// Of every round of the study that people answered, the oldest first.
std::vector<FormReliability> reliability_of_study(casedb::Library& library, const std::string& study_id);

}  // namespace seldinger::reports
