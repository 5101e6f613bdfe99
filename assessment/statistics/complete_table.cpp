#include "assessment/statistics/complete_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "assessment/statistics/spread.h"

namespace seldinger::assessment::statistics {
namespace {

// Names by their first appearance.
class NameOrder {
 public:
  std::size_t of(const std::string& name) {
    const auto [found, is_new] = index_.emplace(name, names_.size());
    if (is_new) names_.push_back(name);
    return found->second;
  }
  const std::vector<std::string>& names() const noexcept { return names_; }

 private:
  std::map<std::string, std::size_t> index_;
  std::vector<std::string> names_;
};

constexpr double kNotThere = std::numeric_limits<double>::quiet_NaN();

// A row of scores for each subject, with NaN where there is none.
struct Scores {
  std::vector<std::string> subjects, columns;
  std::vector<std::vector<double>> rows;
  std::size_t missing = 0;
  const char* reason = nullptr;
};

Scores scores_by_rater(const DataTable& table) {
  Scores scores;
  if (table.subject.empty()) {
    scores.reason = "no_data";
    return scores;
  }
  NameOrder subjects, raters;
  std::vector<std::map<std::size_t, double>> cells;
  for (std::size_t i = 0; i < table.rows; ++i) {
    if (table.subject[i].empty() || table.rater[i].empty()) {
      ++scores.missing;
      continue;
    }
    const std::size_t subject = subjects.of(table.subject[i]), rater = raters.of(table.rater[i]);
    if (subject == cells.size()) cells.emplace_back();
    const double value = table.values.front().values[i];
    if (std::isnan(value)) continue;
    if (!cells[subject].emplace(rater, value).second) scores.reason = "repeated_subject";
  }
  scores.subjects = subjects.names();
  scores.columns = raters.names();
  for (const auto& cell : cells) {
    scores.rows.emplace_back(scores.columns.size(), kNotThere);
    for (const auto& [rater, value] : cell) scores.rows.back()[rater] = value;
  }
  return scores;
}

Scores scores_by_column(const DataTable& table) {
  Scores scores;
  NameOrder subjects;
  for (const Column& column : table.values) scores.columns.push_back(column.name);
  for (std::size_t i = 0; i < table.rows; ++i) {
    if (!table.subject.empty()) {
      if (table.subject[i].empty()) {
        ++scores.missing;
        continue;
      }
      if (subjects.of(table.subject[i]) < scores.rows.size()) {
        scores.reason = "repeated_subject";
        continue;
      }
    }
    scores.rows.emplace_back();
    for (const Column& column : table.values) scores.rows.back().push_back(column.values[i]);
  }
  scores.subjects = subjects.names();
  return scores;
}

}  // namespace

std::vector<double> CompleteTable::column(std::size_t which) const {
  std::vector<double> found;
  for (std::size_t row = 0; row < rows; ++row) found.push_back(at(row, which));
  return found;
}

CompleteTable complete_table(const DataTable& table) {
  Scores scores = table.rater.empty() ? scores_by_column(table) : scores_by_rater(table);
  CompleteTable complete;
  complete.columns = std::move(scores.columns);
  complete.missing = scores.missing;
  complete.reason = scores.reason;
  for (std::size_t i = 0; i < scores.rows.size(); ++i) {
    const std::vector<double>& row = scores.rows[i];
    if (std::any_of(row.begin(), row.end(), [](double one) { return std::isnan(one); })) {
      ++complete.missing;
      continue;
    }
    complete.values.insert(complete.values.end(), row.begin(), row.end());
    ++complete.rows;
    if (!scores.subjects.empty()) complete.subjects.push_back(scores.subjects[i]);
  }
  if (complete.reason != nullptr) return complete;
  const Spread spread = spread_of(complete.values);
  if (complete.values.empty())
    complete.reason = "no_data";
  else if (!spread.computable)
    complete.reason = "no_finite_answer";
  return complete;
}

const char* smaller_than(const CompleteTable& table, std::size_t rows, std::size_t columns) {
  if (table.reason != nullptr) return table.reason;
  return table.rows < rows || table.columns.size() < columns ? "too_few" : nullptr;
}

Answer refused_table(const char* test, const char* reason, const CompleteTable& table, const char* note) {
  Answer answer = not_estimable(test, reason, table.rows);
  answer.missing = table.missing;
  if (note != nullptr) answer.notes.emplace_back(note);
  return answer;
}

}  // namespace seldinger::assessment::statistics
