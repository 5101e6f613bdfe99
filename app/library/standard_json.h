// What the standard commands answer under --json.
#pragma once

#include <string>
#include <vector>

#include "casedb/grading/standards.h"

namespace seldinger::app {

std::string json_of_standard_id(const std::string& standard_id);
std::string json_of_standards(const std::vector<casedb::Standard>& standards);

}  // namespace seldinger::app
