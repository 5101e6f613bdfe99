#include "assessment/statistics/data_table.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "sim/base/check.h"

namespace seldinger::assessment::statistics {

std::vector<GroupCount> IndependentGroups::counts() const {
  std::vector<GroupCount> counts;
  for (const Group& group : groups) counts.push_back({group.name, group.values.size()});
  return counts;
}

IndependentGroups independent_groups(const DataTable& table, const std::vector<std::string>& order) {
  CHECK(!table.values.empty());
  IndependentGroups found;
  for (const std::string& name : order) found.groups.push_back({name, {}});
  const std::vector<double>& values = table.values.front().values;
  std::map<std::string, std::string> group_of_person;
  for (std::size_t i = 0; i < table.rows; ++i) {
    const std::string group = table.group.empty() ? std::string("all") : table.group[i];
    const std::string person = table.subject.empty() ? std::string() : table.subject[i];
    if (std::isnan(values[i]) || group.empty() || (!table.subject.empty() && person.empty())) {
      ++found.missing;
      continue;
    }
    if (!person.empty()) {
      const auto [before, is_new] = group_of_person.emplace(person, group);
      if (!is_new && found.reason == nullptr)
        found.reason = before->second == group ? "repeated_subject" : "subject_in_two_groups";
    }
    auto in =
        std::find_if(found.groups.begin(), found.groups.end(), [&](const Group& one) { return one.name == group; });
    if (in == found.groups.end()) {
      found.groups.push_back({group, {}});
      in = std::prev(found.groups.end());
    }
    in->values.push_back(values[i]);
    ++found.n;
  }
  return found;
}

std::vector<double> present(const std::vector<double>& values) {
  std::vector<double> there;
  std::copy_if(values.begin(), values.end(), std::back_inserter(there),
               [](double one) { return !std::isnan(one); });
  return there;
}

}  // namespace seldinger::assessment::statistics
