// The reports about learners, cases and standards, for `seldinger report`.
#pragma once

#include <string>

#include "app/cli/arguments.h"
#include "sim/base/result.h"

namespace seldinger::app {

// Pages; refused as open_acting, acting_on, and `no_user`, `no_person`, `no_case`.
base::Result<std::string> learner_report(const Arguments& arguments);
base::Result<std::string> case_report(const Arguments& arguments);
base::Result<std::string> standard_report(const Arguments& arguments);

}  // namespace seldinger::app
