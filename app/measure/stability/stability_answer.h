// The answer of `haptics stability`: a page for people (docs/stability.md), a document for programs.
#pragma once

#include <string>

#include "app/measure/stability/stability_survey.h"

namespace seldinger::measure {

std::string markdown_of_stability(const StabilitySurvey& survey);
std::string json_of_stability(const StabilitySurvey& survey);

}  // namespace seldinger::measure
