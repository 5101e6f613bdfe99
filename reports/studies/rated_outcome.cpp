#include "reports/studies/rated_outcome.h"

#include "assessment/statistics/relations/correlation.h"

namespace seldinger::reports {

assessment::statistics::DataTable with_ratings(const assessment::study::Compared& outcome,
                                               const casedb::RatedPeople& rated) {
  assessment::statistics::DataTable table;
  table.values.emplace_back();
  for (const assessment::study::PersonValue& person : outcome.people) {
    const auto found = rated.mean.find(person.name);
    if (person.standing != assessment::study::Standing::value || found == rated.mean.end()) continue;
    table.values.front().values.push_back(person.value);
    table.x.push_back(found->second);
  }
  table.rows = table.x.size();
  return table;
}

assessment::statistics::Answer rank_correlation(const assessment::statistics::DataTable& rated) {
  return assessment::statistics::settled(assessment::statistics::spearman(rated, {}));
}

}  // namespace seldinger::reports
