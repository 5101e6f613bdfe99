// A grade for the terminal: the sentences first, then criteria and score.
#pragma once

#include <string>

#include "casedb/grading/grading.h"

namespace seldinger::app {

std::string text_of_grade(const casedb::AttemptGrade& grade);

}  // namespace seldinger::app
