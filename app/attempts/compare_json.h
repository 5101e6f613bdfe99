// What `attempt compare` answers.
#pragma once

#include <string>

#include "casedb/grading/comparison.h"

namespace seldinger::app {

std::string json_of_comparison(const casedb::Comparison& comparison);

}  // namespace seldinger::app
