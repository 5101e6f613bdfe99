// An answer of a statistical procedure for people: short enough to be quoted.
#pragma once

#include <string>

#include "assessment/statistics/answer.h"

namespace seldinger::app {

std::string text_of_answer(const assessment::statistics::Answer& answer);

}  // namespace seldinger::app
