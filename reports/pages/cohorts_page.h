// Cohorts: who is in those that the reader may see by name, and counts of the others, small ones withheld.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "casedb/people/cohorts.h"
#include "reports/pages/page.h"

namespace seldinger::reports {

struct CohortView {
  casedb::Cohort cohort;
  bool named = false;                    // the reader sees who is in it
  std::vector<std::string> learners{};   // their names
  std::vector<std::string> simulated{};  // likewise, of simulated ones
  casedb::CohortCells cells{};           // where `named` is false, as casedb::told_cells has them
};

std::string cohorts_page(const Visitor& visitor, std::span<const CohortView> cohorts);

}  // namespace seldinger::reports
