#include "assessment/statistics/growth/person_rows.h"

#define EIGEN_MPL2_ONLY
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "assessment/statistics/spread.h"
#include "sim/base/check.h"

namespace seldinger::assessment::statistics {
namespace {

// The number of a label, in the order in which labels come.
class Numbering {
 public:
  std::size_t of(const std::string& label) {
    const auto [at, is_new] = numbers_.emplace(label, labels_.size());
    if (is_new) labels_.push_back(label);
    return at->second;
  }
  const std::vector<std::string>& labels() const { return labels_; }

 private:
  std::map<std::string, std::size_t> numbers_;
  std::vector<std::string> labels_;
};

void count_repeats(PersonRows& rows) {
  std::vector<std::size_t> each(rows.persons), group_of(rows.persons);
  std::vector<std::set<double>> times(rows.persons);
  for (std::size_t i = 0; i < rows.rows(); ++i) {
    const std::size_t person = rows.person[i];
    if (each[person] == 0) group_of[person] = rows.group[i];
    if (group_of[person] != rows.group[i]) rows.group_within = true;
    if (++each[person] == 2) ++rows.repeated;
    if (!rows.x.empty()) times[person].insert(rows.x[i]);
  }
  std::vector<std::size_t> occasions;
  for (const auto& one : times) occasions.push_back(one.size());
  std::sort(occasions.begin(), occasions.end());
  if (!occasions.empty()) rows.occasions = occasions[occasions.size() / 2];
}

}  // namespace

PersonRows person_rows(const DataTable& table) {
  CHECK(!table.values.empty());
  PersonRows rows;
  Numbering persons, groups;
  const std::vector<double>& values = table.values.front().values;
  for (std::size_t i = 0; i < table.rows; ++i) {
    const bool nobody = table.subject.empty() || table.subject[i].empty();
    const bool no_group = !table.group.empty() && table.group[i].empty();
    const bool no_x = !table.x.empty() && std::isnan(table.x[i]);
    if (std::isnan(values[i]) || nobody || no_group || no_x) {
      ++rows.missing;
      continue;
    }
    rows.y.push_back(values[i]);
    if (!table.x.empty()) rows.x.push_back(table.x[i]);
    rows.group.push_back(groups.of(table.group.empty() ? std::string() : table.group[i]));
    rows.person.push_back(persons.of(table.subject[i]));
  }
  rows.groups = groups.labels();
  rows.persons = persons.labels().size();
  count_repeats(rows);
  return rows;
}

FixedEffects fixed_effects(const PersonRows& rows, bool interaction) {
  FixedEffects effects;
  const bool has_x = !rows.x.empty();
  const std::size_t others = rows.groups.empty() ? 0 : rows.groups.size() - 1;
  effects.names.emplace_back("intercept");
  if (has_x) {
    const Spread spread = spread_of(rows.x);
    CHECK(spread.varies && spread.computable);
    effects.centre = spread.mean;
    effects.size = std::sqrt(spread.variance);
    effects.names.emplace_back("x");
  }
  for (std::size_t g = 1; g <= others; ++g) effects.names.push_back(rows.groups[g]);
  if (interaction && has_x)
    for (std::size_t g = 1; g <= others; ++g) effects.names.push_back("x in " + rows.groups[g]);
  effects.columns = effects.names.size();
  effects.columns_with_x = (has_x ? 1 : 0) + (interaction && has_x ? others : 0);
  const std::size_t first_group = has_x ? 2 : 1, first_slope = first_group + others;
  for (std::size_t i = 0; i < rows.rows(); ++i) {
    std::vector<double> row(effects.columns);
    const double x = has_x ? (rows.x[i] - effects.centre) / effects.size : 0.0;
    row[0] = 1.0;
    if (has_x) row[1] = x;
    if (rows.group[i] > 0) {
      row[first_group + rows.group[i] - 1] = 1.0;
      if (interaction && has_x) row[first_slope + rows.group[i] - 1] = x;
    }
    effects.matrix.insert(effects.matrix.end(), row.begin(), row.end());
  }
  // A line at x = 0 and its slope, from the line at the centre.
  effects.weights.assign(effects.columns, std::vector<double>(effects.columns));
  const auto line = [&](std::size_t level, std::size_t slope) {
    effects.weights[slope][slope] = 1.0 / effects.size;
    effects.weights[level][slope] = -effects.centre / effects.size;
  };
  for (std::size_t k = 0; k < effects.columns; ++k) effects.weights[k][k] = 1.0;
  if (has_x) line(0, 1);
  if (interaction && has_x)
    for (std::size_t g = 0; g < others; ++g) line(first_group + g, first_slope + g);
  return effects;
}

bool told_apart(const FixedEffects& effects) {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto columns = static_cast<Eigen::Index>(effects.columns);
  const auto rows = static_cast<Eigen::Index>(effects.matrix.size()) / columns;
  if (rows < columns) return false;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  qr.setThreshold(1e-6);
  qr.compute(Eigen::Map<const Matrix>(effects.matrix.data(), rows, columns));
  return qr.rank() == columns;
}

}  // namespace seldinger::assessment::statistics
