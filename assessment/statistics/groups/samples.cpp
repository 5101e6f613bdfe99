#include "assessment/statistics/groups/samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <utility>

#include "assessment/statistics/distributions.h"

namespace seldinger::assessment::statistics {
namespace {

// Names of the option `order`, each once and each of a group that is there, or the note that says what is wrong.
std::string wrong_order(const DataTable& table, const std::vector<std::string>& order) {
  const std::set<std::string> there(table.group.begin(), table.group.end());
  std::set<std::string> named;
  for (const std::string& name : order) {
    if (name.empty() || !there.contains(name)) return "order names \"" + name + "\", a group that has no rows.";
    if (!named.insert(name).second) return "order names \"" + name + "\" twice.";
  }
  return {};
}

// Rows of the groups that `order` names, and a note about the others.
DataTable only_of(const DataTable& table, const std::vector<std::string>& order, std::vector<std::string>& notes) {
  DataTable kept;
  for (const Column& column : table.values) kept.values.push_back({column.name, {}});
  std::set<std::string> others;
  for (std::size_t i = 0; i < table.rows; ++i) {
    const std::string& group = table.group[i];
    if (!group.empty() && std::find(order.begin(), order.end(), group) == order.end()) {
      others.insert(group);
      continue;
    }
    ++kept.rows;
    for (std::size_t c = 0; c < table.values.size(); ++c)
      kept.values[c].values.push_back(table.values[c].values[i]);
    kept.group.push_back(group);
    if (!table.subject.empty()) kept.subject.push_back(table.subject[i]);
  }
  if (!others.empty()) {
    std::string note = "Left out, since order does not name them:";
    for (const std::string& name : others) note += " " + name;
    notes.push_back(note + ".");
  }
  return kept;
}

GroupsAsked groups_asked(const DataTable& table, const ProcedureOptions& options) {
  GroupsAsked asked;
  const std::vector<std::string> order = options.list("order");
  if (const std::string wrong = wrong_order(table, order); !wrong.empty()) {
    asked.reason = "bad_value";
    asked.notes.push_back(wrong);
    return asked;
  }
  asked.groups =
      order.empty() ? independent_groups(table) : independent_groups(only_of(table, order, asked.notes), order);
  asked.reason = asked.groups.reason;
  return asked;
}

const char* small_group(const IndependentGroups& groups, std::size_t least) {
  for (const Group& group : groups.groups)
    if (group.values.size() < least) return "group_too_small";
  return nullptr;
}

const char* too_few_groups(const IndependentGroups& groups) {
  if (groups.n == 0) return "no_data";
  return groups.groups.size() < 2 ? "one_group" : nullptr;
}

// What each person has under each condition, in the order of first rows.
struct ByPerson {
  std::vector<std::string> persons;
  std::map<std::string, std::map<std::string, double>> values;
  bool repeated = false;
};

ByPerson by_person(const DataTable& table) {
  ByPerson by;
  for (std::size_t i = 0; i < table.rows; ++i) {
    const std::string& person = table.subject[i];
    if (person.empty() || table.group[i].empty()) continue;
    if (!by.values.contains(person)) by.persons.push_back(person);
    const double value = table.values.front().values[i];
    auto& conditions = by.values[person];
    if (!std::isnan(value)) by.repeated = !conditions.emplace(table.group[i], value).second || by.repeated;
  }
  return by;
}

}  // namespace

Answer GroupsAsked::refused(const char* test) const {
  Answer answer = not_estimable(test, reason, groups.n, groups.counts());
  answer.missing = groups.missing;
  answer.notes = notes;
  return answer;
}

Answer GroupsAsked::answer(const char* test, std::string method) const {
  Answer answer;
  answer.test = test;
  answer.method = std::move(method);
  answer.n = groups.n;
  answer.missing = groups.missing;
  answer.groups = groups.counts();
  answer.notes = notes;
  return answer;
}

GroupsAsked two_groups(const DataTable& table, const ProcedureOptions& options, std::size_t least) {
  GroupsAsked asked = groups_asked(table, options);
  if (asked.reason != nullptr) return asked;
  asked.reason = too_few_groups(asked.groups);
  if (asked.reason == nullptr && asked.groups.groups.size() > 2) {
    asked.reason = "not_two_groups";
    asked.notes.emplace_back("order=a:b names the two.");
  }
  if (asked.reason == nullptr) asked.reason = small_group(asked.groups, least);
  return asked;
}

GroupsAsked several_groups(const DataTable& table, const ProcedureOptions& options, std::size_t least) {
  GroupsAsked asked = groups_asked(table, options);
  if (asked.reason == nullptr) asked.reason = too_few_groups(asked.groups);
  if (asked.reason == nullptr) asked.reason = small_group(asked.groups, least);
  return asked;
}

Answer Blocks::refused(const char* test) const {
  Answer answer = not_estimable(test, reason, values.size());
  answer.missing = missing;
  answer.notes = notes;
  return answer;
}

Answer Blocks::answer(const char* test, std::string method) const {
  Answer answer;
  answer.test = test;
  answer.method = std::move(method);
  answer.n = values.size();
  answer.missing = missing;
  for (const std::string& condition : conditions) answer.groups.push_back({condition, values.size()});
  answer.notes = notes;
  return answer;
}

Blocks complete_blocks(const DataTable& table, const ProcedureOptions& options) {
  Blocks blocks;
  const std::vector<std::string> order = options.list("order");
  if (const std::string wrong = wrong_order(table, order); !wrong.empty()) {
    blocks.reason = "bad_value";
    blocks.notes.push_back(wrong);
    return blocks;
  }
  const DataTable& kept = order.empty() ? table : only_of(table, order, blocks.notes);
  blocks.conditions = order;
  for (const std::string& name : kept.group)
    if (!name.empty() &&
        std::find(blocks.conditions.begin(), blocks.conditions.end(), name) == blocks.conditions.end())
      blocks.conditions.push_back(name);
  const ByPerson by = by_person(kept);
  if (by.persons.empty())
    blocks.reason = "no_data";
  else if (by.repeated)
    blocks.reason = "repeated_subject";
  else if (blocks.conditions.size() < 2)
    blocks.reason = "one_group";
  if (blocks.reason != nullptr) return blocks;
  for (const std::string& person : by.persons) {
    std::vector<double> row;
    for (const std::string& condition : blocks.conditions) {
      const auto found = by.values.at(person).find(condition);
      if (found != by.values.at(person).end()) row.push_back(found->second);
    }
    if (row.size() == blocks.conditions.size())
      blocks.values.push_back(std::move(row));
    else
      ++blocks.missing;
  }
  if (blocks.missing > 0) blocks.notes.emplace_back("Persons with a condition missing are left out.");
  if (blocks.values.empty()) blocks.reason = "no_data";
  return blocks;
}

Pairs complete_pairs(const DataTable& table, const ProcedureOptions& options, std::size_t least) {
  Pairs pairs{complete_blocks(table, options), {}};
  if (pairs.blocks.reason != nullptr) return pairs;
  if (pairs.blocks.conditions.size() > 2) {
    pairs.blocks.reason = "not_two_groups";
    pairs.blocks.notes.emplace_back("order=a:b names the two conditions.");
  } else if (pairs.blocks.values.size() < least) {
    pairs.blocks.reason = "too_few";
  } else {
    for (const std::vector<double>& pair : pairs.blocks.values) pairs.differences.push_back(pair[0] - pair[1]);
  }
  return pairs;
}

Answer bad_option(const char* test, const std::string& note) {
  Answer answer = not_estimable(test, "bad_value", 0);
  answer.notes.push_back(note);
  return answer;
}

std::optional<double> number_within(const ProcedureOptions& options, const char* name, double fallback, double low,
                                    double high) {
  const std::optional<double> value = options.number(name, fallback);
  return value && *value >= low && *value <= high ? value : std::nullopt;
}

std::string in_words(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

double two_sided_normal(double z) {
  return std::min(1.0, 2.0 * normal_upper(std::abs(z)));
}

}  // namespace seldinger::assessment::statistics
