#include "assessment/statistics/relations/observations.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "sim/base/check.h"

namespace seldinger::assessment::statistics {
namespace {

// Counts above are beyond what doubles and tables of probabilities hold.
constexpr double kMostCounted = 1e9;

class Reader {
 public:
  Reader(const DataTable& table, const Wanted& wanted, const ProcedureOptions& options)
      : table_(table), with_x_(wanted.x && !table.x.empty()), with_group_(wanted.group && !table.group.empty()) {
    rows_.values.resize(wanted.columns);
    if (with_group_) rows_.groups = options.list("order");
    only_named_ = !rows_.groups.empty();
  }

  Observations read() {
    for (std::size_t i = 0; i < table_.rows; ++i) read_row(i);
    if (!with_group_) rows_.groups = {"all"};
    if (left_out_ > 0)
      rows_.notes.push_back("Rows of groups that `order` does not name are left out: " + std::to_string(left_out_) +
                            ".");
    return std::move(rows_);
  }

 private:
  void read_row(std::size_t i) {
    if (with_group_ && only_named_ && !table_.group[i].empty() &&
        place_of(table_.group[i]) == rows_.groups.size()) {
      ++left_out_;
      return;
    }
    bool there = !(with_group_ && table_.group[i].empty()) && !(with_x_ && std::isnan(table_.x[i])) &&
                 !(!table_.subject.empty() && table_.subject[i].empty());
    for (std::size_t c = 0; c < rows_.values.size(); ++c) there = there && !std::isnan(table_.values[c].values[i]);
    if (!there) {
      ++rows_.missing;
      return;
    }
    const std::size_t group = with_group_ ? place_of(table_.group[i]) : 0;
    if (with_group_ && group == rows_.groups.size()) rows_.groups.push_back(table_.group[i]);
    if (!table_.subject.empty()) meet(table_.subject[i], group);
    rows_.group.push_back(group);
    for (std::size_t c = 0; c < rows_.values.size(); ++c) {
      rows_.values[c].push_back(table_.values[c].values[i]);
      if (std::isinf(rows_.values[c].back())) refuse("bad_value");
    }
    if (with_x_) rows_.x.push_back(table_.x[i]);
    if (with_x_ && std::isinf(table_.x[i])) refuse("bad_value");
    ++rows_.n;
  }

  std::size_t place_of(const std::string& name) const {
    return static_cast<std::size_t>(std::find(rows_.groups.begin(), rows_.groups.end(), name) -
                                    rows_.groups.begin());
  }

  void meet(const std::string& person, std::size_t group) {
    const auto [before, is_new] = group_of_person_.emplace(person, group);
    if (!is_new) refuse(before->second == group ? "repeated_subject" : "subject_in_two_groups");
  }

  void refuse(const char* reason) {
    if (rows_.reason == nullptr) rows_.reason = reason;
  }

  const DataTable& table_;
  bool with_x_, with_group_, only_named_ = false;
  std::size_t left_out_ = 0;
  std::map<std::string, std::size_t> group_of_person_;
  Observations rows_;
};

std::size_t persons_as_if_equal(const Answer& answer) {
  std::size_t least = answer.n;
  for (const GroupCount& group : answer.groups) least = std::min(least, group.n);
  return least * answer.groups.size();
}

}  // namespace

std::vector<GroupCount> Observations::counts() const {
  std::vector<GroupCount> counts;
  for (const std::string& name : groups) counts.push_back({name, 0});
  for (const std::size_t one : group) ++counts[one].n;
  return counts;
}

std::vector<double> Observations::values_of(std::size_t which_group, std::size_t column) const {
  std::vector<double> found;
  for (std::size_t i = 0; i < n; ++i)
    if (group[i] == which_group) found.push_back(values[column][i]);
  return found;
}

std::vector<double> Observations::x_of(std::size_t which_group) const {
  std::vector<double> found;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (group[i] == which_group) found.push_back(x[i]);
  return found;
}

Observations observations(const DataTable& table, const Wanted& wanted, const ProcedureOptions& options) {
  CHECK(table.values.size() >= wanted.columns);
  return Reader(table, wanted, options).read();
}

const char* not_two_groups(const Observations& rows, std::size_t least) {
  if (rows.reason != nullptr) return rows.reason;
  if (rows.n == 0) return "no_data";
  if (rows.groups.size() < 2) return "one_group";
  if (rows.groups.size() > 2) return "not_two_groups";
  for (const GroupCount& group : rows.counts())
    if (group.n < least) return "group_too_small";
  return nullptr;
}

bool all_zero_or_one(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double one) { return one == 0.0 || one == 1.0; });
}

bool all_counts(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](double one) { return one >= 0.0 && one <= kMostCounted && one == std::floor(one); });
}

void warn_of_interval(Answer& answer, std::size_t enough) {
  if (!answer.ci95 || persons_as_if_equal(answer) >= enough) return;
  answer.notes.push_back("In simulations, intervals like this with fewer than " + std::to_string(enough) +
                         " persons held the truth in fewer than 93 of 100 samples.");
}

void warn_of_test(Answer& answer, std::size_t enough) {
  if (!answer.p_value || persons_as_if_equal(answer) >= enough) return;
  answer.notes.push_back("In simulations, this test with fewer than " + std::to_string(enough) +
                         " persons rejected more than 6 of 100 true equalities at 5 %.");
}

Answer begun(const char* test, const Observations& rows) {
  Answer answer;
  answer.test = test;
  answer.n = rows.n;
  answer.missing = rows.missing;
  answer.groups = rows.counts();
  answer.notes = rows.notes;
  return answer;
}

Answer refused(const char* test, const char* reason, const Observations& rows, const char* note) {
  Answer answer = not_estimable(test, reason, rows.n, rows.counts());
  answer.missing = rows.missing;
  answer.notes = rows.notes;
  if (note != nullptr) answer.notes.emplace_back(note);
  return answer;
}

}  // namespace seldinger::assessment::statistics
