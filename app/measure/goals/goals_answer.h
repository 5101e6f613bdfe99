// The answers of `goals ultrasound` and `goals haptics`: a table for people, a document for programs.
#pragma once

#include <string>
#include <vector>

#include "app/measure/goals/force_goals.h"
#include "app/measure/ultrasound_goals/goal.h"

namespace seldinger::measure {

struct GoalsOfMethod {
  std::string method;
  Quality quality;
  Readings readings;  // by goal, then probe
};

// One row a reading: measured, both tolerances, measured over the asked tolerance, holds or not.
std::string goals_table(const GoalsOfMethod& measured);
std::string json_of_goals(const std::vector<GoalsOfMethod>& measured);

std::string goals_table(const std::vector<ForceReading>& readings);
std::string json_of_goals(const std::vector<ForceReading>& readings);

// "scatterers", "lattice", "thesis", and back; nothing for another name.
const char* name_of(imaging::UltrasoundMethod method) noexcept;
constexpr imaging::UltrasoundMethod kUltrasoundMethods[] = {
    imaging::UltrasoundMethod::scatterers, imaging::UltrasoundMethod::lattice, imaging::UltrasoundMethod::thesis};

}  // namespace seldinger::measure
