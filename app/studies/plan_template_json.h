// A plan to begin with: every field that a plan can have, valid as it stands, its words to be replaced.
#pragma once

#include <string>

namespace seldinger::app {

std::string plan_template(const std::string& case_id);

}  // namespace seldinger::app
