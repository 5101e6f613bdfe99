// Every condition of an attempt, one row each: its name in database, JSON and export, its words on pages, its unit,
// and what it means. Store, JSON, export, page and data dictionary loop over these rows; a new condition is a field
// of Conditions and a row here.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "casedb/attempts/conditions.h"

namespace seldinger::casedb {

// Not known; yes or no; a number; a name or words.
using ConditionValue = std::variant<std::monostate, bool, double, std::string>;

enum class ConditionKind { flag, whole, number, text };

struct ConditionRow {
  const char* id;     // snake_case
  const char* words;  // for pages: "needle in the hand"
  ConditionKind kind;
  const char* unit;     // empty: none
  const char* about;    // what it means
  const char* missing;  // when it is not known
  ConditionValue (*read)(const Conditions&);
  // False: it is no such value, and nothing is changed.
  bool (*write)(Conditions&, const ConditionValue&);
};

std::span<const ConditionRow> condition_rows();
const ConditionRow* find_condition(std::string_view id);  // nullptr: there is none

}  // namespace seldinger::casedb
