// What the standard commands answer under --json.
#pragma once

#include <string>
#include <vector>

#include "casedb/grading/cuts.h"
#include "casedb/grading/standards.h"

namespace seldinger::app {

std::string json_of_standard_id(const std::string& standard_id);
std::string json_of_standards(const std::vector<casedb::Standard>& standards);
std::string json_of_cut_id(const std::string& cut_id);
std::string json_of_cuts(const std::vector<casedb::Cut>& cuts);

}  // namespace seldinger::app
