// The answer of `haptics stability`: a page for people (docs/stability.md), a document for programs.
#pragma once

#include <string>

#include "sim/haptics/stability_survey.h"

namespace seldinger::app {

std::string markdown_of_stability(const haptics::StabilitySurvey& survey);
std::string json_of_stability(const haptics::StabilitySurvey& survey);

}  // namespace seldinger::app
