#include "assessment/statistics/reliability/alpha.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/spread.h"
#include "assessment/statistics/square_matrix.h"

namespace seldinger::assessment::statistics {
namespace {

CompleteTable without_item(const CompleteTable& items, std::size_t dropped) {
  CompleteTable left = items;
  left.columns.erase(left.columns.begin() + static_cast<std::ptrdiff_t>(dropped));
  left.values.clear();
  for (std::size_t row = 0; row < items.rows; ++row)
    for (std::size_t j = 0; j < items.columns.size(); ++j)
      if (j != dropped) left.values.push_back(items.at(row, j));
  return left;
}

SquareMatrix item_covariance(const CompleteTable& items) {
  std::vector<std::vector<double>> columns;
  for (std::size_t j = 0; j < items.columns.size(); ++j) columns.push_back(items.column(j));
  return covariance_of(columns);
}

double alpha_of(const SquareMatrix& covariance) {
  const double k = static_cast<double>(covariance.n);
  return k / (k - 1.0) * (1.0 - covariance.trace() / covariance.sum());
}

// Guttman's second bound.
double lambda2_of(const SquareMatrix& covariance) {
  const double k = static_cast<double>(covariance.n), all = covariance.sum();
  double squares = 0.0;
  for (std::size_t i = 0; i < covariance.n; ++i)
    for (std::size_t j = 0; j < covariance.n; ++j)
      if (i != j) squares += covariance.at(i, j) * covariance.at(i, j);
  return (all - covariance.trace() + std::sqrt(k / (k - 1.0) * squares)) / all;
}

// Guttman's sixth bound: less what each item has that the others do not tell.
std::optional<double> lambda6_of(const SquareMatrix& covariance) {
  const std::optional<SquareMatrix> inverse = inverse_of(covariance);
  if (!inverse) return std::nullopt;
  double own = 0.0;
  for (std::size_t i = 0; i < inverse->n; ++i) own += 1.0 / inverse->at(i, i);
  return 1.0 - own / covariance.sum();
}

// An item's correlation with the sum of the others.
double item_rest(const SquareMatrix& covariance, std::size_t item) {
  double with_all = 0.0;
  for (std::size_t j = 0; j < covariance.n; ++j) with_all += covariance.at(item, j);
  const double own = covariance.at(item, item), rest = covariance.sum() - 2.0 * with_all + own;
  return (with_all - own) / std::sqrt(own * rest);
}

std::vector<Row> item_rows(const CompleteTable& items, const SquareMatrix& covariance) {
  std::vector<Row> rows;
  for (std::size_t j = 0; j < items.columns.size(); ++j) {
    const Spread spread = spread_of(items.column(j));
    Row row{items.columns[j],
            {{"mean", spread.mean}, {"sd", std::sqrt(spread.variance)}, {"item_rest_r", item_rest(covariance, j)}}};
    if (items.columns.size() > 2)
      row.values.push_back({"alpha_if_dropped", cronbach_alpha(without_item(items, j))});
    rows.push_back(std::move(row));
  }
  return rows;
}

void note_items(Answer& answer) {
  for (const Row& row : answer.rows)
    if (row.values[2].value < 0.0)
      answer.notes.push_back(row.name + " goes against the other items: does it have to be reversed?");
  if (answer.estimate < 0.0)
    answer.notes.emplace_back("Alpha is negative, and shown as it is: the items do not measure one thing.");
}

}  // namespace

std::string turn_items(CompleteTable& items, const ItemScale& scale) {
  if (scale.low && scale.high && !(*scale.low < *scale.high)) return "The option low is not below high.";
  for (const double value : items.values)
    if ((scale.low && value < *scale.low) || (scale.high && value > *scale.high))
      return "An answer lies outside the scale from low to high.";
  if (scale.reverse.empty()) return {};
  if (!scale.low || !scale.high) return "The option reverse needs the ends of the scale, low and high.";
  for (const std::string& name : scale.reverse) {
    const auto found = std::find(items.columns.begin(), items.columns.end(), name);
    if (found == items.columns.end()) return "The option reverse names something that is not an item.";
    const auto j = static_cast<std::size_t>(found - items.columns.begin());
    for (std::size_t row = 0; row < items.rows; ++row) {
      double& value = items.values[row * items.columns.size() + j];
      value = *scale.low + *scale.high - value;
    }
  }
  return {};
}

std::vector<std::string> drop_constant_items(CompleteTable& items) {
  std::vector<std::string> names;
  for (std::size_t j = items.columns.size(); j-- > 0;) {
    if (spread_of(items.column(j)).variance > 0.0) continue;
    names.insert(names.begin(), items.columns[j]);
    items = without_item(items, j);
  }
  return names;
}

std::string said_of_constant_items(const std::vector<std::string>& names) {
  std::string said;
  for (const std::string& name : names) said += (said.empty() ? "" : ", ") + name;
  if (names.size() == 1) return said + " does not vary and is left out.";
  return said.empty() ? said : said + " do not vary and are left out.";
}

double cronbach_alpha(const CompleteTable& items) {
  return alpha_of(item_covariance(items));
}

Answer alpha(CompleteTable items, const ItemScale& scale) {
  if (const char* reason = smaller_than(items, 3, 2)) return refused_table("alpha", reason, items);
  if (const std::string wrong = turn_items(items, scale); !wrong.empty())
    return refused_table("alpha", "bad_value", items, wrong.c_str());
  const std::vector<std::string> constant = drop_constant_items(items);
  if (items.columns.size() < 2)
    return refused_table("alpha", "no_variation", items, said_of_constant_items(constant).c_str());
  const SquareMatrix covariance = item_covariance(items), correlation = correlation_of(covariance);
  if (!(covariance.sum() > 1e-14 * covariance.trace()))
    return refused_table("alpha", "no_variation", items, "The persons' sums over the items do not vary.");
  const double value = alpha_of(covariance);
  const double n = static_cast<double>(items.rows), k = static_cast<double>(items.columns.size());
  const double df1 = n - 1.0, df2 = (n - 1.0) * (k - 1.0);
  Answer answer;
  answer.test = "alpha";
  answer.method = "Cronbach's alpha of the items as scored, Feldt's interval; lambda 2 and 6 of standardised items";
  answer.n = items.rows;
  answer.missing = items.missing;
  answer.estimate = value;
  answer.estimate_name = "alpha";
  // 1 / F as its upper quantile: the lower one of few degrees of freedom loses digits.
  answer.ci95 = Interval{1.0 - (1.0 - value) * f_quantile(0.975, df1, df2),
                         1.0 - (1.0 - value) / f_quantile(0.975, df2, df1)};
  answer.more = {{"items", k},
                 {"alpha_standardized", alpha_of(correlation)},
                 {"lambda2", lambda2_of(correlation)},
                 {"mean_inter_item_r", (correlation.sum() - k) / (k * (k - 1.0))}};
  if (const std::optional<double> bound = lambda6_of(correlation))
    answer.more.push_back({"lambda6", *bound});
  else
    answer.notes.emplace_back("Lambda 6 is left out: an item is determined by the others.");
  answer.rows = item_rows(items, covariance);
  note_items(answer);
  if (!constant.empty()) answer.notes.push_back(said_of_constant_items(constant));
  if (items.missing > 0) answer.notes.emplace_back("Persons who left an item out are left out.");
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
