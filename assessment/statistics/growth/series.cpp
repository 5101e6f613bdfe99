#include "assessment/statistics/growth/series.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "sim/base/check.h"

namespace seldinger::assessment::statistics {
namespace {

void put_in_order(Series& series) {
  std::vector<std::size_t> order(series.x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return series.x[a] < series.x[b]; });
  Series sorted{series.person, {}, {}};
  for (const std::size_t i : order) {
    sorted.x.push_back(series.x[i]);
    sorted.values.push_back(series.values[i]);
  }
  series = std::move(sorted);
}

}  // namespace

PersonsSeries persons_series(const DataTable& table) {
  CHECK(!table.values.empty());
  PersonsSeries found;
  const std::vector<double>& values = table.values.front().values;
  std::map<std::string, std::size_t> place;
  for (std::size_t i = 0; i < table.rows; ++i) {
    const bool no_person = !table.subject.empty() && table.subject[i].empty();
    const bool no_x = !table.x.empty() && std::isnan(table.x[i]);
    if (std::isnan(values[i]) || no_person || no_x) {
      ++found.missing;
      continue;
    }
    const std::string person = table.subject.empty() ? std::string() : table.subject[i];
    const auto [at, is_new] = place.emplace(person, found.persons.size());
    if (is_new) found.persons.push_back({person, {}, {}});
    Series& series = found.persons[at->second];
    series.x.push_back(table.x.empty() ? static_cast<double>(series.values.size() + 1) : table.x[i]);
    series.values.push_back(values[i]);
    ++found.values;
  }
  for (Series& series : found.persons) put_in_order(series);
  return found;
}

}  // namespace seldinger::assessment::statistics
