#include "app/statistics/procedures.h"

#include <algorithm>
#include <vector>

#include "assessment/statistics/groups/groups_procedures.h"
#include "assessment/statistics/growth/growth_procedures.h"
#include "assessment/statistics/relations/relations_procedures.h"
#include "assessment/statistics/reliability/reliability_procedures.h"
#include "assessment/statistics/standards/standards_procedures.h"

namespace seldinger::app {

std::span<const assessment::statistics::Procedure> procedures() {
  namespace shelves = assessment::statistics;
  static const std::vector<shelves::Procedure> kAll = [] {
    std::vector<shelves::Procedure> all;
    for (const auto shelf :
         {shelves::groups_procedures(), shelves::relations_procedures(), shelves::reliability_procedures(),
          shelves::standards_procedures(), shelves::growth_procedures()})
      all.insert(all.end(), shelf.begin(), shelf.end());
    return all;
  }();
  return kAll;
}

const assessment::statistics::Procedure* find_procedure(std::string_view name) {
  const auto all = procedures();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& one) { return name == one.name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace seldinger::app
