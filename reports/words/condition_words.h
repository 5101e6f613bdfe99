// The conditions of an attempt in words for people.
#pragma once

#include <optional>
#include <string>

#include "casedb/attempts/condition_table.h"

namespace seldinger::reports {

// What is known, in a line: "mouse for needle and probe; needle guide for 34 % of the time; 2 pauses, 41 s". Empty:
// nothing is. `away_s`: for how long the attempt lay interrupted.
std::string conditions_text(const casedb::Conditions& conditions, std::optional<double> away_s);

// One of them, with its unit; "not known" where it is not.
std::string condition_text(const casedb::ConditionRow& row, const casedb::Conditions& conditions);

}  // namespace seldinger::reports
