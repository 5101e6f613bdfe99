// An error as --json answers it.
#pragma once

#include <string>

#include "sim/base/result.h"

namespace seldinger::app {

// {"error": {"code", "text"}}, with "findings" beside them where there are any.
std::string json_of_error(const base::Error& error);

}  // namespace seldinger::app
