#include "reports/studies/numbers/baseline.h"

#include <algorithm>

#include "assessment/grading/standard.h"
#include "casedb/people/cohorts.h"
#include "reports/studies/numbers/relations.h"

namespace seldinger::reports {

std::vector<BaselineRow> baseline_of(const assessment::study::Plan& plan,
                                     const std::map<std::string, casedb::Background>& people) {
  std::vector<BaselineRow> rows;
  for (const casedb::FactInfo& fact : casedb::fact_infos()) {
    if (fact.is_choice()) continue;
    const auto stated = stated_of(fact, people);
    if (stated.empty()) continue;
    BaselineRow& row = rows.emplace_back(BaselineRow{&fact, {}});
    for (const assessment::study::PlannedGroup& group : plan.groups) {
      BaselineCell& cell = row.groups.emplace_back();
      for (const auto& [name, value] : stated)
        if (people.at(name).group == group.name) cell.stated.push_back(value);
      if (cell.stated.size() < casedb::kSmallestCell) continue;
      std::sort(cell.stated.begin(), cell.stated.end());
      cell.median = assessment::quantile(cell.stated, 0.5);
      cell.low_quartile = assessment::quantile(cell.stated, 0.25);
      cell.high_quartile = assessment::quantile(cell.stated, 0.75);
    }
  }
  return rows;
}

}  // namespace seldinger::reports
