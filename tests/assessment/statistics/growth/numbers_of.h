// Numbers of an answer by their names.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "assessment/statistics/answer.h"

namespace seldinger::fixtures {

// NaN, which no comparison passes: it has none of that name.
inline double number_of(const std::vector<assessment::statistics::Named>& values, const std::string& name) {
  for (const auto& one : values)
    if (one.name == name) return one.value;
  return std::nan("");
}
inline double number_of(const assessment::statistics::Answer& answer, const std::string& name) {
  return number_of(answer.more, name);
}
inline double number_of(const assessment::statistics::Answer& answer, const std::string& row,
                        const std::string& name) {
  for (const auto& one : answer.rows)
    if (one.name == row) return number_of(one.values, name);
  return std::nan("");
}

}  // namespace seldinger::fixtures
