#include "assessment/statistics/answer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "assessment/statistics/reasons.h"
#include "sim/base/check.h"

namespace seldinger::assessment::statistics {
namespace {

bool taken_away(std::optional<double>& value) {
  if (!value || std::isfinite(*value)) return false;
  value.reset();
  return true;
}

bool taken_away(std::optional<Interval>& interval) {
  if (!interval || (std::isfinite(interval->low) && std::isfinite(interval->high))) return false;
  interval.reset();
  return true;
}

bool taken_away(std::vector<Named>& values) {
  return std::erase_if(values, [](const Named& one) { return !std::isfinite(one.value); }) > 0;
}

}  // namespace

Answer not_estimable(std::string test, const char* reason, std::size_t n, std::vector<GroupCount> groups) {
  CHECK(find_reason(reason) != nullptr);
  Answer answer;
  answer.test = std::move(test);
  answer.reason = reason;
  answer.n = n;
  answer.groups = std::move(groups);
  return answer;
}

Answer settled(Answer answer) {
  if (!answer.estimable()) return answer;
  bool lost = taken_away(answer.statistic);
  lost = taken_away(answer.p_value) || lost;
  lost = taken_away(answer.estimate) || lost;
  lost = taken_away(answer.ci95) || lost;
  lost = taken_away(answer.more) || lost;
  if (std::any_of(answer.df.begin(), answer.df.end(), [](double one) { return !std::isfinite(one); })) {
    answer.df.clear();
    lost = true;
  }
  for (Row& row : answer.rows) lost = taken_away(row.values) || lost;
  if (answer.p_value) answer.p_value = std::clamp(*answer.p_value, 0.0, 1.0);
  const bool nothing =
      !answer.statistic && !answer.p_value && !answer.estimate && answer.more.empty() &&
      std::all_of(answer.rows.begin(), answer.rows.end(), [](const Row& row) { return row.values.empty(); });
  if (nothing) {
    Answer none = not_estimable(answer.test, "no_finite_answer", answer.n, answer.groups);
    none.method = std::move(answer.method);
    none.missing = answer.missing;
    none.notes = std::move(answer.notes);
    return none;
  }
  if (lost) answer.notes.emplace_back("What is not a finite number for these values is left out.");
  return answer;
}

}  // namespace seldinger::assessment::statistics
