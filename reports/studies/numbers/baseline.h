// What people of each group stated of themselves before they were enrolled.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "assessment/study/plan.h"
#include "casedb/people/facts.h"
#include "casedb/studies/study_data.h"

namespace seldinger::reports {

struct BaselineCell {
  std::vector<double> stated;
  // Of casedb::kSmallestCell persons or more.
  std::optional<double> median, low_quartile, high_quartile;
};
struct BaselineRow {
  const casedb::FactInfo* fact = nullptr;
  std::vector<BaselineCell> groups;  // in the plan's order
};
// Of each fact that is a number and that somebody stated.
std::vector<BaselineRow> baseline_of(const assessment::study::Plan& plan,
                                     const std::map<std::string, casedb::Background>& people);

}  // namespace seldinger::reports
