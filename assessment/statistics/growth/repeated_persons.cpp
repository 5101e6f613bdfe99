#include "assessment/statistics/growth/repeated_persons.h"

#include <cmath>

#include "assessment/statistics/spread.h"

namespace seldinger::assessment::statistics {

Answer no_repeated_persons(const char* test, const PersonRows& rows, const char* reason, const char* why) {
  Answer answer = not_estimable(test, reason, rows.persons);
  answer.missing = rows.missing;
  answer.notes.emplace_back(why);
  return answer;
}

std::optional<Answer> unfit_for_model(const char* test, const PersonRows& rows) {
  if (rows.rows() == 0) return no_repeated_persons(test, rows, "no_data", "There is no complete row.");
  if (rows.repeated < 2)
    return no_repeated_persons(test, rows, "too_few", "A mixed model needs two persons with more than one value.");
  if (rows.groups.size() > kMostGroupsOfModel)
    return no_repeated_persons(test, rows, "too_many", "There may be 20 groups.");
  if (!rows.x.empty()) {
    const Spread spread = spread_of(rows.x);
    if (!spread.varies) return no_repeated_persons(test, rows, "no_variation", "x does not vary.");
    if (!spread.computable)
      return no_repeated_persons(test, rows, "no_finite_answer", "x is too large or varies too little.");
  }
  return std::nullopt;
}

Answer of_repeated_persons(const char* test, const PersonRows& rows) {
  Answer answer;
  answer.test = test;
  answer.n = rows.persons;
  answer.missing = rows.missing;
  if (rows.groups.size() > 1) {
    for (const std::string& group : rows.groups) answer.groups.push_back({group, 0});
    for (const std::size_t group : rows.group) ++answer.groups[group].n;
    answer.notes.emplace_back("The n of a group counts its values; the n of the answer counts persons.");
  }
  if (rows.group_within)
    answer.notes.emplace_back("Some persons are in more than one group: they are compared with themselves.");
  return answer;
}

std::string effect_name(const FixedEffects& fixed, const PersonRows& rows, std::size_t effect) {
  if (effect == 0) return "mean of an average person";
  if (!rows.x.empty() && effect == 1)
    return fixed.columns_with_x > 1 ? "slope of x in " + rows.groups.front() : std::string("slope of x");
  return "difference (" + rows.groups[1] + " − " + rows.groups[0] + ")";
}

}  // namespace seldinger::assessment::statistics
